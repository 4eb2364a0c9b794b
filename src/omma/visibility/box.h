#pragma once

#include <glm/glm.hpp>
#include <limits>

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

}  // namespace omma
