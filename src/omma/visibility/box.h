#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "omma/math/bounds.h"

namespace omma {

/// Around points, which lie where whoever uses it says. A new one holds nothing.
struct Box {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  float half_area() const {
    const glm::vec3 e = max - min;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

inline Bounds to_bounds(const Box& box) { return {glm::dvec3(box.min), glm::dvec3(box.max)}; }

/// Rounded outwards, within what single precision holds.
inline Box to_box(const Bounds& bounds) {
  constexpr double most = 1e38;
  const glm::dvec3 room = 1e-6 * glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return {glm::vec3(glm::clamp(bounds.min - room, -most, most)), glm::vec3(glm::clamp(bounds.max + room, -most, most))};
}

}  // namespace omma
