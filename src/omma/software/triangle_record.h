// What is constant over a visible triangle: in C++ what shaders/technique/triangle.glsl computes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "omma/software/seen_triangle.h"

namespace omma {

/// All in the camera frame, metres. Attributes are those of the first corner and how much those of the others differ
/// from it. Read as an array of floats by whoever shades sixteen fragments at a time.
struct TriangleRecord {
  glm::vec3 sum;  ///< of the edge planes: the triangle's normal, of any length
  float volume;   ///< det(a, b, c)
  glm::vec3 plane_b, plane_c;
  glm::vec2 uv, uv_b, uv_c;
  glm::vec3 normal, normal_b, normal_c;  ///< on the camera's side
  glm::vec4 tangent;                     ///< w: the bitangent's sign; zero for meshes without
  glm::vec3 tangent_b, tangent_c;
  glm::vec4 color, color_b, color_c;  ///< linear; white for meshes without
};

/// Single precision's view of an instance, for records.
struct RecordInstance {
  RecordInstance(const SeenInstance& seen, const glm::dmat3& cameraFromWorld, bool shows_surroundings);

  const Mesh* mesh;
  uint32_t first_triangle;
  int32_t material;
  bool reflects;  ///< shows what surrounds it
  glm::dmat4 cameraFromObject;
  glm::mat3 directions;  ///< to the camera frame
  glm::mat3 normals;     ///< to the camera frame, by the cofactors
};

/// `triangle` is an id over all instances, one of `instance`.
TriangleRecord triangle_record(const RecordInstance& instance, uint32_t triangle);

}  // namespace omma
