// Rays over a lattice of points of an image, and what they say of the rays between those points.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

/// Radians, of unit vectors.
double angle_between(const glm::dvec3& a, const glm::dvec3& b);

struct RayGrid {
  double step;       ///< pixels
  glm::dvec2 first;  ///< image pixels
  int columns, rows;
  std::vector<glm::dvec3> rays{};  ///< zero where there is none

  glm::dvec2 place(int x, int y) const { return first + step * glm::dvec2(x, y); }
  const glm::dvec3& at(int x, int y) const { return rays[size_t(y) * size_t(columns) + size_t(x)]; }
  static bool is_ray(const glm::dvec3& ray) { return ray != glm::dvec3(0.0); }

  void fill_row(const Camera& camera, int y);
};

/// Part of a grid, the last column and row included.
struct GridPart {
  int x0, y0, x1, y1;
};

/// True where no point lacks a ray.
bool is_whole(const RayGrid& grid, const GridPart& part);

/// True where none does, and rays change from point to point by much the same angles.
bool is_even(const RayGrid& grid, const GridPart& part);

/// Of any width, unlike those of visibility/.
struct WideCone {
  glm::dvec3 axis{0.0, 0.0, -1.0};
  double angle = 0.0;  ///< radians; up to pi
};

/// A cone around the rays of a part and those between its points, up to `reach` steps beyond its outer points. Nothing
/// when there are no rays.
std::optional<WideCone> cone_around(const RayGrid& grid, const GridPart& part, double reach);

/// Rays as a linear function of the pixel: with u and v from -1 to 1 across a square, middle + u across + v down is
/// along the ray but for a vector of length `off`, and its projection on the square's mean ray has length 1 or nearly
/// so.
struct LinearRays {
  glm::dvec3 middle, across, down;
  double off;

  /// Pixels, of a square of `side` pixels, at worst.
  double off_px(int side) const;
};

/// True where a look at a part's middle and corners tells that no linear function is within `limit` pixels; the grid's
/// step and the rays say what a pixel is.
bool is_plainly_bent(const RayGrid& grid, const GridPart& part, double limit);

/// Of the rays of an even part. The square is given by its centre, image pixels, and its side.
LinearRays linear_rays(const RayGrid& grid, const GridPart& part, const glm::dvec2& centre, int side);

}  // namespace omma
