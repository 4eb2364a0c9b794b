// The tree of a camera's rays on the GPU.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "omma/gl/context.h"
#include "omma/gl/objects.h"
#include "omma/visibility/cone_levels.h"
#include "omma/visibility/ray_tree.h"

namespace omma {

class GpuRays {
 public:
  /// Throws MachineError when the driver's buffers are too small for so many.
  GpuRays(const RayTree& rays, const gl::Limits& limits);

  /// Texture units 10, 12 and 16.
  void bind() const;

  ImageSize size() const { return size_; }
  /// As in ConeLevels. Both are zero where there is no ray.
  const std::vector<ConeLevels::Level>& levels() const { return levels_; }
  uint32_t node_count() const { return levels_.back().first + levels_.back().count; }
  /// Of whole blocks, in their order: with those beyond the image's border, and those that are none.
  size_t ray_count() const { return blocks_.size() * 256; }

  /// Calls `each(number, pixel)` for the rays of a block that are any, and pixels from the top left, row by row.
  template <typename Each>
  void each_ray(size_t block, const Each& each) const {
    const Block& b = blocks_[block];
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      for (int ray = 0; ray < 16; ++ray) {
        if ((b.rays[size_t(leaf)] >> ray & 1) == 0) continue;
        const size_t x = size_t(b.corner.x + RayBlock::x_of(leaf, ray)),
                     y = size_t(b.corner.y + RayBlock::y_of(leaf, ray));
        each(block * 256 + size_t(leaf * 16 + ray), y * size_t(size_.width) + x);
      }
    }
  }
  size_t block_count() const { return blocks_.size(); }
  /// Of a ray.
  size_t pixel_of(uint32_t number) const;

  size_t bytes() const { return directions_.bytes() + masks_.bytes() + cones_.bytes(); }

 private:
  struct Block {
    glm::ivec2 corner;
    std::array<uint16_t, RayBlock::leaves> rays;
  };
  ImageSize size_;
  std::vector<Block> blocks_;
  std::vector<ConeLevels::Level> levels_;
  gl::Texels directions_{GL_RGB32F}, masks_{GL_R16UI}, cones_{GL_RGBA32UI};
};

}  // namespace omma
