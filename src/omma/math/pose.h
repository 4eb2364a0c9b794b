// Where a camera stands and looks. World: right-handed, metres, +Y up. Camera: +X right, +Y up, looks along -Z.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace omma {

/// `from` and `to` in world metres. When `up` is parallel to the view direction another axis takes its place, so the
/// result is always a rigid transform. `from` must differ from `to`.
inline glm::dmat4 look_at_worldFromCamera(const glm::dvec3& from, const glm::dvec3& to,
                                          const glm::dvec3& up = {0.0, 1.0, 0.0}) {
  const glm::dvec3 backward = glm::normalize(from - to);
  glm::dvec3 right = glm::cross(up, backward);
  if (glm::length(right) < 1e-9 * glm::length(up)) {
    right = glm::cross(std::abs(backward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), backward);
  }
  right = glm::normalize(right);
  return glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(backward, right), 0.0), glm::dvec4(backward, 0.0),
                    glm::dvec4(from, 1.0));
}

}  // namespace omma
