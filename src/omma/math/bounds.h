// Axis-aligned bounding box.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace omma {

/// Empty until the first point is added.
struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return min.x > max.x; }
  glm::dvec3 center() const { return 0.5 * (min + max); }
  glm::dvec3 extent() const { return max - min; }

  void add(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Bounds& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }

  /// The box around this box's eight transformed corners.
  Bounds transformed(const glm::dmat4& matrix) const {
    Bounds result;
    if (empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 point(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z);
      result.add(glm::dvec3(matrix * glm::dvec4(point, 1.0)));
    }
    return result;
  }
};

}  // namespace omma
