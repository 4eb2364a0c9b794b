// Where a direction lies among the pixels of a block of rays, whatever the camera's formula: the projection onto a
// plane that comes nearest to it.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace omma {

/// A direction d in front lies at column (column · d) / (axis · d) of the block, 0 being the first ray's, and at such a
/// row. The block's own rays lie there within `column_error` and `row_error`; these are infinite where no plane will
/// do.
struct PixelGrid {
  glm::vec3 column{0.0f}, row{0.0f}, axis{0.0f};
  float column_error = std::numeric_limits<float>::infinity(), row_error = std::numeric_limits<float>::infinity();
};

struct RayBlock;

/// By least squares, of a block whose rays and cone are known.
PixelGrid fit_pixel_grid(const RayBlock& block);

}  // namespace omma
