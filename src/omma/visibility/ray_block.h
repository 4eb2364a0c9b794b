// Squares of 16 x 16 pixels as the finder takes them: their rays, and the cones that enclose these. They know no
// camera's formula, so they serve every camera.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "omma/visibility/pixel_grid.h"

namespace omma {

/// All directions d of unit length with d · axis >= cos, where the angle is less than 80°. A wider cone is everything:
/// axis 0, sin 1, cos 0.
struct Cone {
  glm::vec3 axis{0.0f};  ///< unit length, or zero
  float sin = 1.0f, cos = 0.0f;
};

/// 16 x 16 pixels: sixteen leaves of sixteen rays. Leaves and the rays of a leaf go row by row.
struct alignas(64) RayBlock {
  static constexpr int leaf_side = 4, leaves = 16, side = 16;

  float x[leaves][16], y[leaves][16], z[leaves][16];  ///< directions in the camera frame; zero for no ray
  float axis_x[leaves], axis_y[leaves], axis_z[leaves], sin[leaves], cos[leaves];  ///< the leaves' cones
  Cone cone;                                                                       ///< of all rays
  PixelGrid grid;
  uint32_t leaf_mask;     ///< leaves that have a ray
  uint16_t rays[leaves];  ///< of each leaf: those that are rays
  int pixel_x, pixel_y;   ///< of the first ray

  Cone leaf_cone(int leaf) const { return {{axis_x[leaf], axis_y[leaf], axis_z[leaf]}, sin[leaf], cos[leaf]}; }
  static int x_of(int leaf, int ray) { return leaf % 4 * leaf_side + ray % leaf_side; }
  static int y_of(int leaf, int ray) { return leaf / 4 * leaf_side + ray / leaf_side; }
};

/// The rays around a square of pixels: what tells how rays change from pixel to pixel at its border. Zero for no ray.
struct alignas(64) SquareBorder {
  enum Side { left, right, above, below };
  float x[4][RayBlock::side], y[4][RayBlock::side], z[4][RayBlock::side];  ///< by side; from the top or from the left
};

/// Puts the direction that `at(column, row)` gives for each pixel of a square into its block.
template <typename At>
void put_rays(const At& at, RayBlock& block) {
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      const glm::vec3 d = at(RayBlock::x_of(leaf, ray), RayBlock::y_of(leaf, ray));
      block.x[leaf][ray] = d.x;
      block.y[leaf][ray] = d.y;
      block.z[leaf][ray] = d.z;
    }
  }
}

/// The same for the pixels around it: columns and rows from -1 to RayBlock::side.
template <typename At>
void put_border(const At& at, SquareBorder& border) {
  const auto put = [&](SquareBorder::Side side, int i, int column, int row) {
    const glm::vec3 d = at(column, row);
    border.x[side][i] = d.x;
    border.y[side][i] = d.y;
    border.z[side][i] = d.z;
  };
  for (int i = 0; i < RayBlock::side; ++i) {
    put(SquareBorder::left, i, -1, i);
    put(SquareBorder::right, i, RayBlock::side, i);
    put(SquareBorder::above, i, i, -1);
    put(SquareBorder::below, i, i, RayBlock::side);
  }
}

/// Where the rays of a block begin, metres in the camera frame. The block sees the scene from its apex, in the middle
/// of its rays' beginnings; they lie within `radius` of it.
struct alignas(64) BlockOrigins {
  float x[RayBlock::leaves][16], y[RayBlock::leaves][16], z[RayBlock::leaves][16];  ///< from the apex
  float moment_x[RayBlock::leaves][16], moment_y[RayBlock::leaves][16],
      moment_z[RayBlock::leaves][16];  ///< x × direction
  float along[RayBlock::leaves][16];   ///< x · direction
  glm::vec3 apex;
  float radius;
};

}  // namespace omma
