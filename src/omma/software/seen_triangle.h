// The point where a ray meets a triangle that is known to be seen: what shaders/technique/triangle.glsl and
// triangle_surface.glsl compute, in C++ and in double precision.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "omma/scene/scene.h"

namespace omma {

/// An instance as a camera sees it.
struct SeenInstance {
  SeenInstance(const Scene& scene, const Instance& instance, const glm::dmat4& cameraFromWorld);

  const Mesh* mesh;
  uint32_t first_triangle;
  int32_t object, material;
  glm::dmat4 cameraFromObject;
  glm::dmat3 normals;  ///< to the world, by the cofactors: of any length
};

struct SeenPoint {
  double distance;  ///< metres along the ray
  glm::dvec2 bc;    ///< barycentric weights of the second and third corner
};

/// What is constant over a triangle.
class SeenTriangle {
 public:
  /// `triangle` is an id over all instances, one of `instance`.
  SeenTriangle(const SeenInstance& instance, uint32_t triangle);

  const SeenInstance& instance() const { return *instance_; }

  /// `direction` is of unit length; `distance` is what a finder says in single precision, which stands where the
  /// triangle is seen so nearly edge-on that its plane says nothing.
  SeenPoint at(const glm::dvec3& direction, double distance) const;

  /// World, unit length, on the camera's side of the triangle.
  glm::dvec3 normal(const SeenPoint& point) const;
  /// Zero for a mesh without texture coordinates.
  glm::dvec2 uv(const SeenPoint& point) const;

 private:
  glm::dvec2 nearest_to(const glm::dvec3& point) const;

  const SeenInstance* instance_;
  glm::uvec3 corner_;
  glm::dvec3 a_, ab_, ac_;  ///< camera frame
  glm::dvec3 sum_, plane_b_, plane_c_;
  double volume_;
};

}  // namespace omma
