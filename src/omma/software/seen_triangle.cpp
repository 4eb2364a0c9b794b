#include "omma/software/seen_triangle.h"

#include <algorithm>

namespace omma {
namespace {

glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

template <typename Vertices>
auto interpolated(const Vertices& values, const glm::uvec3& corner, const glm::dvec2& bc) {
  using Value = std::conditional_t<std::decay_t<decltype(values[0])>::length() == 2, glm::dvec2, glm::dvec3>;
  const Value a(values[corner.x]);
  return a + bc.x * (Value(values[corner.y]) - a) + bc.y * (Value(values[corner.z]) - a);
}

}  // namespace

SeenInstance::SeenInstance(const Scene& scene, const Instance& instance, const glm::dmat4& cameraFromWorld)
    : mesh(&scene.meshes[size_t(instance.mesh)]),
      first_triangle(instance.first_triangle),
      object(instance.object),
      material(mesh->material),
      cameraFromObject(cameraFromWorld * instance.worldFromObject),
      normals(cofactors(glm::dmat3(instance.worldFromObject))) {}

SeenTriangle::SeenTriangle(const SeenInstance& instance, uint32_t triangle)
    : instance_(&instance), corner_(instance.mesh->triangles[triangle - instance.first_triangle]) {
  const auto seen = [&](uint32_t corner) {
    return glm::dvec3(instance.cameraFromObject * glm::dvec4(glm::dvec3(instance.mesh->positions[corner]), 1.0));
  };
  a_ = seen(corner_.x);
  ab_ = seen(corner_.y) - a_;
  ac_ = seen(corner_.z) - a_;
  sum_ = glm::cross(ab_, ac_);
  plane_b_ = glm::cross(ac_, a_);
  plane_c_ = glm::cross(a_, ab_);
  volume_ = glm::dot(a_, sum_);
}

SeenPoint SeenTriangle::at(const glm::dvec3& direction, double distance) const {
  const double scale = 1.0 / glm::dot(sum_, direction);
  const SeenPoint point{volume_ * scale,
                        scale * glm::dvec2(glm::dot(plane_b_, direction), glm::dot(plane_c_, direction))};
  // Single precision may see a small triangle a little beside its place, but not beyond its own size.
  constexpr double beside = 1.0;
  const double least = std::min({point.bc.x, point.bc.y, 1.0 - point.bc.x - point.bc.y});
  if (point.distance > 0.0 && least >= -beside) return point;
  return {distance, nearest_to(distance * direction)};
}

glm::dvec2 SeenTriangle::nearest_to(const glm::dvec3& point) const {
  const double size = glm::dot(sum_, sum_);
  if (!(size > 0.0)) return glm::dvec2(0.0);
  const glm::dvec3 offset = point - a_;
  const glm::dvec2 bc = glm::max(
      glm::dvec2(glm::dot(glm::cross(ac_, sum_), offset), glm::dot(glm::cross(sum_, ab_), offset)) / size, 0.0);
  return bc / std::max(1.0, bc.x + bc.y);
}

glm::dvec3 SeenTriangle::normal(const SeenPoint& point) const {
  const Mesh& mesh = *instance_->mesh;
  glm::dvec3 sum = instance_->normals * interpolated(mesh.normals, corner_, point.bc);
  if (!(glm::dot(sum, sum) > 0.0)) {
    // Normals that cancel say nothing; the triangle itself does.
    const glm::dvec3 a(mesh.positions[corner_.x]), b(mesh.positions[corner_.y]), c(mesh.positions[corner_.z]);
    sum = instance_->normals * glm::cross(b - a, c - a);
  }
  return sum * ((volume_ < 0.0 ? 1.0 : -1.0) / glm::length(sum));
}

glm::dvec2 SeenTriangle::uv(const SeenPoint& point) const {
  const Mesh& mesh = *instance_->mesh;
  return mesh.uvs.empty() ? glm::dvec2(0.0) : interpolated(mesh.uvs, corner_, point.bc);
}

}  // namespace omma
