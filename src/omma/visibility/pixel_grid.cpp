#include "omma/visibility/pixel_grid.h"

#include <algorithm>
#include <cmath>

#include "omma/visibility/ray_tree.h"

namespace omma {
namespace {

/// Calls `each(column, row, direction)` for the rays that there are.
template <typename Each>
void each_ray(const RayBlock& block, const Each& each) {
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      if (!(block.rays[leaf] >> ray & 1)) continue;
      each(RayBlock::x_of(leaf, ray), RayBlock::y_of(leaf, ray),
           glm::dvec3(block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]));
    }
  }
}

/// Never none: what rays in one row and nothing else say of columns would leave no room at all. Of too few rays, a grid
/// may be no numbers.
float error_of(double largest) { return largest < 1e3 ? float(largest) + 1e-3f : PixelGrid().column_error; }

}  // namespace

PixelGrid fit_pixel_grid(const RayBlock& block) {
  PixelGrid grid;
  const glm::dvec3 axis(block.cone.axis);
  if (axis == glm::dvec3(0.0)) return grid;
  const glm::dvec3 aside = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, aside)), up = glm::cross(right, axis);
  // Both coordinates are sums of three terms: two coordinates on the plane one unit ahead, and one.
  glm::dmat3 squares(0.0);
  glm::dvec3 columns(0.0), rows(0.0);
  each_ray(block, [&](int column, int row, const glm::dvec3& d) {
    const glm::dvec3 on_plane = glm::dvec3(glm::dot(right, d), glm::dot(up, d), glm::dot(axis, d)) / glm::dot(axis, d);
    squares += glm::outerProduct(on_plane, on_plane);
    columns += on_plane * double(column);
    rows += on_plane * double(row);
  });
  const glm::dmat3 solve = glm::inverse(squares), basis(right, up, axis);
  grid.column = glm::vec3(basis * (solve * columns));
  grid.row = glm::vec3(basis * (solve * rows));
  grid.axis = block.cone.axis;
  double column_error = 0.0, row_error = 0.0;
  each_ray(block, [&](int column, int row, const glm::dvec3& d) {
    const double ahead = glm::dot(axis, d);
    column_error = std::max(std::abs(glm::dot(glm::dvec3(grid.column), d) / ahead - column), column_error);
    row_error = std::max(std::abs(glm::dot(glm::dvec3(grid.row), d) / ahead - row), row_error);
  });
  grid.column_error = error_of(column_error);
  grid.row_error = error_of(row_error);
  return grid;
}

}  // namespace omma
