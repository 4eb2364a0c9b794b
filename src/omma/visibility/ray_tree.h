// The rays of an image as a tree: blocks of 16 x 16 pixels, leaves of 4 x 4, and for each the cone that encloses its
// rays. It knows no camera's formula, so it serves every camera.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "omma/camera/camera.h"

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
  uint32_t leaf_mask;                                                              ///< leaves that have a ray
  uint16_t rays[leaves];  ///< of each leaf: those that are rays
  int pixel_x, pixel_y;   ///< of the first ray

  Cone leaf_cone(int leaf) const { return {{axis_x[leaf], axis_y[leaf], axis_z[leaf]}, sin[leaf], cos[leaf]}; }
  static int x_of(int leaf, int ray) { return leaf % 4 * leaf_side + ray % leaf_side; }
  static int y_of(int leaf, int ray) { return leaf / 4 * leaf_side + ray / leaf_side; }
};

class RayTree {
 public:
  RayTree() = default;
  /// Directions of unit length, or zero for no ray. Runs on all cores.
  explicit RayTree(const RayMap& rays);

  ImageSize size() const { return size_; }
  /// Those in which there is a ray, neighbours near to each other.
  const std::vector<RayBlock>& blocks() const { return blocks_; }
  /// The first pixels of those in which there is none.
  const std::vector<glm::ivec2>& blank() const { return blank_; }
  size_t bytes() const { return blocks_.size() * sizeof(RayBlock); }

 private:
  ImageSize size_;
  std::vector<RayBlock> blocks_;
  std::vector<glm::ivec2> blank_;
};

}  // namespace omma
