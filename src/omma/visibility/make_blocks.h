// Blocks of rays, made of patches or of given rays: for every SIMD target.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "omma/camera/ray_patch.h"
#include "omma/visibility/ray_block.h"

namespace omma {

/// A square of pixels, all of which a patch has the rays of, and those around it too.
struct PatchSquare {
  const RayPatch* patch = nullptr;
  glm::dvec2 first{0.0};               ///< the centre of its first pixel, in the patch's image
  glm::ivec2 inside{RayBlock::side};   ///< columns and rows from there that are pixels of the image
  std::span<const glm::dvec2> shifts;  ///< from the pixels' centres: one for each sample
};

/// Fills a block for each shift, but for its place in the image, and the border around the first one's rays. By the
/// best SIMD target of this processor.
void make_blocks(const PatchSquare& square, std::span<RayBlock> blocks, SquareBorder& border);

/// Fills the cones, grid and masks of a block that has its rays. Returns false when there is none.
bool finish_block(RayBlock& block);

}  // namespace omma
