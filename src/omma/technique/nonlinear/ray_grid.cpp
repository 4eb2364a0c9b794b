#include "omma/technique/nonlinear/ray_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace omma {
namespace {

struct Spread {
  double least = glm::pi<double>(), most = 0.0;
  void add(double angle) {
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  bool smooth() const { return most <= 1.5 * least; }
};

/// How rays change from point to point of a part.
struct Changes {
  Spread across{}, down{};
  int missing = 0;  ///< points without a ray

  bool even() const { return missing == 0 && across.smooth() && down.smooth(); }
};

Changes changes_in(const RayGrid& grid, const GridPart& part) {
  Changes changes;
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3& ray = grid.at(x, y);
      changes.missing += !RayGrid::is_ray(ray);
      if (!RayGrid::is_ray(ray)) continue;
      if (x < part.x1 && RayGrid::is_ray(grid.at(x + 1, y))) {
        changes.across.add(angle_between(ray, grid.at(x + 1, y)));
      }
      if (y < part.y1 && RayGrid::is_ray(grid.at(x, y + 1))) {
        changes.down.add(angle_between(ray, grid.at(x, y + 1)));
      }
    }
  }
  return changes;
}

/// The sum of a part's rays and their number.
glm::dvec4 sum_of(const RayGrid& grid, const GridPart& part) {
  glm::dvec4 sum(0.0);
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      sum += glm::dvec4(grid.at(x, y), RayGrid::is_ray(grid.at(x, y)) ? 1.0 : 0.0);
    }
  }
  return sum;
}

}  // namespace

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * glm::distance(a, b)));
}

void RayGrid::fill_row(const Camera& camera, int y) {
  for (int x = 0; x < columns; ++x) {
    const auto ray = camera.unproject(place(x, y));
    rays[size_t(y) * size_t(columns) + size_t(x)] = ray ? ray->direction : glm::dvec3(0.0);
  }
}

bool is_whole(const RayGrid& grid, const GridPart& part) {
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      if (!RayGrid::is_ray(grid.at(x, y))) return false;
    }
  }
  return true;
}

bool is_even(const RayGrid& grid, const GridPart& part) { return changes_in(grid, part).even(); }

std::optional<WideCone> cone_around(const RayGrid& grid, const GridPart& part, double reach) {
  const Changes changes = changes_in(grid, part);
  const glm::dvec4 sum = sum_of(grid, part);
  if (sum.w == 0.0) return std::nullopt;
  WideCone cone;
  const double step = std::max(changes.across.most, changes.down.most);
  // A single ray says nothing of those around it.
  if (glm::length(glm::dvec3(sum)) < 1e-6 || step == 0.0) {
    cone.angle = glm::pi<double>();
    return cone;
  }
  cone.axis = glm::normalize(glm::dvec3(sum));
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3& ray = grid.at(x, y);
      if (RayGrid::is_ray(ray)) cone.angle = std::max(cone.angle, angle_between(cone.axis, ray));
    }
  }
  // Where rays change evenly those between points bulge little beyond them; else they may change faster than was seen.
  const double between = changes.even() ? 0.1 : 4.0;
  cone.angle = std::min(glm::pi<double>(), cone.angle + (between + 1.5 * reach) * step + 1e-7);
  return cone;
}

double LinearRays::off_px(int side) const {
  // The least singular value of the map from the square to its rays.
  const double aa = glm::dot(across, across), bb = glm::dot(down, down), ab = glm::dot(across, down);
  const double least2 = 0.5 * (aa + bb - std::hypot(aa - bb, 2.0 * ab));
  return least2 > 0.0 ? 0.5 * side * off / std::sqrt(least2) : std::numeric_limits<double>::infinity();
}

bool is_plainly_bent(const RayGrid& grid, const GridPart& part, double limit) {
  const glm::dvec3 middle = grid.at((part.x0 + part.x1) / 2, (part.y0 + part.y1) / 2);
  const std::array corners{grid.at(part.x0, part.y0), grid.at(part.x1, part.y0), grid.at(part.x0, part.y1),
                           grid.at(part.x1, part.y1)};
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& corner : corners) {
    if (glm::dot(corner, middle) < 0.1) return true;
    mean += 0.25 * corner / glm::dot(corner, middle);
  }
  // Of a linear function the middle is the corners' mean: any is off by half of what they differ by, at one of the
  // five. A part without a point in its very middle may have them differ by a step more.
  const glm::dvec2 steps(part.x1 - part.x0, part.y1 - part.y0);
  const double widest = 0.5 *
                        std::max(glm::distance(corners[0], corners[1]) + glm::distance(corners[2], corners[3]),
                                 glm::distance(corners[0], corners[2]) + glm::distance(corners[1], corners[3])) /
                        (std::min(steps.x, steps.y) * grid.step);
  return 0.25 * glm::distance(mean, middle) > limit * widest + widest * grid.step;
}

LinearRays linear_rays(const RayGrid& grid, const GridPart& part, const glm::dvec2& centre, int side) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(sum_of(grid, part)));
  const auto flattened = [&](int x, int y) { return grid.at(x, y) / glm::dot(grid.at(x, y), axis); };
  // Least squares; on a lattice its two directions part.
  const glm::dvec2 middle = 0.5 * glm::dvec2(part.x0 + part.x1, part.y0 + part.y1);
  glm::dvec3 mean(0.0), along_x(0.0), along_y(0.0);
  glm::dvec2 squares(0.0);
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3 ray = flattened(x, y);
      const glm::dvec2 at = glm::dvec2(x, y) - middle;
      mean += ray;
      along_x += at.x * ray;
      along_y += at.y * ray;
      squares += at * at;
    }
  }
  mean /= double(part.x1 - part.x0 + 1) * double(part.y1 - part.y0 + 1);
  along_x /= squares.x;
  along_y /= squares.y;

  const double half = 0.5 * side / grid.step;  // in steps
  const glm::dvec2 from_middle = (centre - grid.first) / grid.step - middle;
  LinearRays linear{mean + from_middle.x * along_x + from_middle.y * along_y, half * along_x, half * along_y, 0.0};
  // Between points rays leave the straight line by no more than a second difference, even where they have a kink.
  double at_points = 0.0, bend_x = 0.0, bend_y = 0.0;
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3 ray = flattened(x, y);
      const glm::dvec2 at = glm::dvec2(x, y) - middle;
      at_points = std::max(at_points, glm::distance(ray, mean + at.x * along_x + at.y * along_y));
      if (x > part.x0 && x < part.x1) {
        bend_x = std::max(bend_x, glm::length(flattened(x - 1, y) - 2.0 * ray + flattened(x + 1, y)));
      }
      if (y > part.y0 && y < part.y1) {
        bend_y = std::max(bend_y, glm::length(flattened(x, y - 1) - 2.0 * ray + flattened(x, y + 1)));
      }
    }
  }
  linear.off = at_points + bend_x + bend_y + 1e-7;
  return linear;
}

}  // namespace omma
