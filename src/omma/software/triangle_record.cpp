#include "omma/software/triangle_record.h"

namespace omma {
namespace {

glm::vec4 linear(const glm::u8vec4& color) { return glm::vec4(color) * (1.0f / 255.0f); }

}  // namespace

RecordInstance::RecordInstance(const SeenInstance& seen, const glm::dmat3& cameraFromWorld, bool shows_surroundings)
    : mesh(seen.mesh),
      first_triangle(seen.first_triangle),
      material(seen.material),
      reflects(shows_surroundings),
      cameraFromObject(seen.cameraFromObject),
      directions(glm::dmat3(seen.cameraFromObject)),
      normals(cameraFromWorld * seen.normals) {}

TriangleRecord triangle_record(const RecordInstance& instance, uint32_t triangle) {
  const Mesh& mesh = *instance.mesh;
  const glm::uvec3 corner = mesh.triangles[triangle - instance.first_triangle];
  const auto seen = [&](uint32_t vertex) {
    return glm::vec3(instance.cameraFromObject * glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1.0));
  };
  const glm::vec3 a = seen(corner.x), ab = seen(corner.y) - a, ac = seen(corner.z) - a;
  TriangleRecord record{};
  record.sum = glm::cross(ab, ac);
  record.plane_b = glm::cross(ac, a);
  record.plane_c = glm::cross(a, ab);
  record.volume = glm::dot(a, record.sum);

  if (!mesh.uvs.empty()) {
    record.uv = mesh.uvs[corner.x];
    record.uv_b = mesh.uvs[corner.y] - record.uv;
    record.uv_c = mesh.uvs[corner.z] - record.uv;
  }
  // Cofactors turn a mirrored instance's normals round with its winding.
  const glm::mat3 normals = record.volume < 0.0f ? instance.normals : -instance.normals;
  const glm::vec3 normal = mesh.normals[corner.x];
  record.normal = normals * normal;
  record.normal_b = normals * (mesh.normals[corner.y] - normal);
  record.normal_c = normals * (mesh.normals[corner.z] - normal);
  if (!mesh.tangents.empty()) {
    const glm::vec4 tangent = mesh.tangents[corner.x];
    record.tangent = glm::vec4(instance.directions * glm::vec3(tangent), tangent.w);
    record.tangent_b = instance.directions * glm::vec3(mesh.tangents[corner.y] - tangent);
    record.tangent_c = instance.directions * glm::vec3(mesh.tangents[corner.z] - tangent);
  }
  record.color = glm::vec4(1.0f);
  if (!mesh.colors.empty()) {
    record.color = linear(mesh.colors[corner.x]);
    record.color_b = linear(mesh.colors[corner.y]) - record.color;
    record.color_c = linear(mesh.colors[corner.z]) - record.color;
  }
  return record;
}

}  // namespace omma
