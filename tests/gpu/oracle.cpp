#include "tests/gpu/oracle.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

namespace omma {

Oracle::Oracle(const Scene& scene, const glm::dmat4& worldFromCamera)
    : scene_(&scene), worldFromCamera_(worldFromCamera) {
  for (const Material& material : scene.materials) {
    if (material.alpha != Material::Alpha::opaque) throw std::logic_error("the oracle knows opaque materials only");
  }
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    const glm::dmat4 cameraFromObject = cameraFromWorld * instance.worldFromObject;
    // Facing is decided where the mesh was modelled, so that no rule for mirrored transforms is needed.
    const glm::dvec3 eye(glm::inverse(cameraFromObject)[3]);
    const bool double_sided = scene.materials[size_t(mesh.material)].double_sided;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      glm::dvec3 object[3], v[3];
      for (int c = 0; c < 3; ++c) {
        object[c] = glm::dvec3(mesh.positions[mesh.triangles[t][c]]);
        v[c] = glm::dvec3(cameraFromObject * glm::dvec4(object[c], 1.0));
      }
      const glm::dvec3 outward = glm::cross(object[1] - object[0], object[2] - object[0]);
      const bool culled = !double_sided && !(glm::dot(outward, eye - object[0]) > 0.0);
      glm::dmat3 planes(glm::cross(v[1], v[2]), glm::cross(v[2], v[0]), glm::cross(v[0], v[1]));
      const double volume = glm::dot(v[0], planes[0]);
      if (volume < 0.0) planes = -planes;
      triangles_.push_back(
          {planes, std::abs(volume), instance.first_triangle + uint32_t(t), uint32_t(i), culled || volume == 0.0});
    }
  }
}

std::optional<Oracle::Hit> Oracle::meet(const Triangle& triangle, const glm::dvec3& direction) {
  glm::dvec3 inside;
  for (int e = 0; e < 3; ++e) {
    inside[e] = glm::dot(triangle.planes[e], direction);
    if (inside[e] < 0.0) return {};
  }
  const double sum = inside.x + inside.y + inside.z;
  if (!(sum > 0.0)) return {};
  return Hit{triangle.id, triangle.instance, triangle.volume / sum, inside / sum};
}

std::optional<Oracle::Hit> Oracle::nearest(const glm::dvec3& direction) const {
  std::optional<Hit> first;
  for (const Triangle& triangle : triangles_) {
    if (triangle.culled) continue;
    const auto hit = meet(triangle, direction);
    if (hit && (!first || hit->distance < first->distance)) first = hit;
  }
  return first;
}

std::optional<Oracle::Hit> Oracle::meet(uint32_t triangle, const glm::dvec3& direction) const {
  if (triangle >= triangles_.size() || triangles_[triangle].culled) return {};
  return meet(triangles_[triangle], direction);
}

bool Oracle::ends_within(uint32_t triangle, const glm::dvec3& direction, double angle) const {
  const glm::dmat3& planes = triangles_.at(triangle).planes;
  for (int e = 0; e < 3; ++e) {
    if (std::abs(glm::dot(planes[e], direction)) <= angle * glm::length(planes[e])) return true;
  }
  return false;
}

const glm::uvec3& Oracle::corners(const Hit& hit) const {
  const Instance& instance = scene_->instances[hit.instance];
  return scene_->meshes[size_t(instance.mesh)].triangles[hit.triangle - instance.first_triangle];
}

glm::dvec3 Oracle::normal(const Hit& hit) const {
  const Instance& instance = scene_->instances[hit.instance];
  const Mesh& mesh = scene_->meshes[size_t(instance.mesh)];
  const glm::uvec3 corner = corners(hit);
  glm::dvec3 sum(0.0), p[3];
  for (int c = 0; c < 3; ++c) {
    sum += hit.weights[c] * glm::dvec3(mesh.normals[corner[c]]);
    p[c] = glm::dvec3(mesh.positions[corner[c]]);
  }
  const glm::dvec3 eye(glm::inverse(instance.worldFromObject) * worldFromCamera_[3]);
  if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), eye - p[0]) < 0.0) sum = -sum;
  return glm::normalize(glm::transpose(glm::inverse(glm::dmat3(instance.worldFromObject))) * sum);
}

glm::dvec2 Oracle::uv(const Hit& hit) const {
  const Mesh& mesh = scene_->meshes[size_t(scene_->instances[hit.instance].mesh)];
  if (mesh.uvs.empty()) return glm::dvec2(0.0);
  const glm::uvec3 corner = corners(hit);
  glm::dvec2 sum(0.0);
  for (int c = 0; c < 3; ++c) sum += hit.weights[c] * glm::dvec2(mesh.uvs[corner[c]]);
  return sum;
}

double Oracle::uv_per_metre(const Hit& hit) const {
  const Instance& instance = scene_->instances[hit.instance];
  const Mesh& mesh = scene_->meshes[size_t(instance.mesh)];
  if (mesh.uvs.empty()) return 0.0;
  const glm::uvec3 corner = corners(hit);
  double most = 0.0;
  for (int c = 0; c < 3; ++c) {
    const uint32_t from = corner[c], to = corner[(c + 1) % 3];
    const glm::dvec3 edge(mesh.positions[to] - mesh.positions[from]);
    const double metres = glm::length(glm::dmat3(instance.worldFromObject) * edge);
    if (metres > 0.0)
      most = std::max(most, glm::distance(glm::dvec2(mesh.uvs[from]), glm::dvec2(mesh.uvs[to])) / metres);
  }
  return most;
}

double Oracle::cosine(const Hit& hit, const glm::dvec3& direction) const {
  const glm::dmat3& planes = triangles_[hit.triangle].planes;
  // The sum of the three edge planes is the triangle's normal.
  return std::abs(glm::dot(glm::normalize(planes[0] + planes[1] + planes[2]), direction));
}

namespace {

enum class Match { exact, edge, tie, wrong };

int32_t first_id(const Oracle& oracle, const Camera& camera, const glm::dvec2& pixel) {
  const auto ray = camera.unproject(pixel);
  if (!ray) return -1;
  const auto first = oracle.nearest(ray->direction);
  return first ? int32_t(first->triangle) : -1;
}

bool ties(const Oracle& oracle, const Camera& camera, const glm::dvec2& pixel, int32_t id) {
  const auto ray = camera.unproject(pixel);
  if (!ray || id < 0) return false;
  const auto first = oracle.nearest(ray->direction), other = oracle.meet(uint32_t(id), ray->direction);
  return first && other && other->distance - first->distance <= 1e-5 * first->distance;
}

/// The triangle is on a ray near the pixel, behind one that ends within the radius.
bool shows_through(const Oracle& oracle, const Camera& camera, const glm::dvec2& pixel, const glm::dvec2& near_pixel,
                   int32_t id, double radius) {
  const auto ray = camera.unproject(pixel), near_ray = camera.unproject(near_pixel),
             beside = camera.unproject(pixel + glm::dvec2(radius, 0.0));
  const int32_t first = first_id(oracle, camera, pixel);
  if (!ray || !near_ray || !beside || first < 0 || id < 0) return false;
  return oracle.meet(uint32_t(id), near_ray->direction) &&
         oracle.ends_within(uint32_t(first), ray->direction, glm::distance(ray->direction, beside->direction));
}

Match match(const Oracle& oracle, const Camera& camera, const glm::dvec2& pixel, int32_t id, const Forgiven& forgiven) {
  if (first_id(oracle, camera, pixel) == id) return Match::exact;
  Match best = Match::wrong;
  // Circles within circles: a triangle seen edge on may be thinner than the radius.
  for (const double share : {1.0, 0.5, 0.25, 0.0}) {
    for (int i = 0; i < 16; ++i) {
      const double angle = i * glm::pi<double>() / 8.0;
      const glm::dvec2 beside = pixel + share * forgiven.radius * glm::dvec2(std::cos(angle), std::sin(angle));
      if (first_id(oracle, camera, beside) == id) return Match::edge;
      if (forgiven.cracks && shows_through(oracle, camera, pixel, beside, id, forgiven.radius)) return Match::edge;
      if (ties(oracle, camera, beside, id)) best = Match::tie;
    }
  }
  return best;
}

}  // namespace

Verdict judge(const Oracle& oracle, const Camera& camera, const IntImage& ids, const Forgiven& forgiven,
              const IntImage* agreed) {
  Verdict verdict;
  for (int y = 0; y < ids.size.height; ++y) {
    for (int x = 0; x < ids.size.width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const int32_t id = *ids.at(x, y);
      const bool is_agreed = agreed != nullptr && *agreed->at(x, y) == id;
      const Match found = is_agreed ? Match::exact : match(oracle, camera, pixel, id, forgiven);
      ++verdict.pixels;
      verdict.hits += id >= 0;
      verdict.edges += found == Match::edge;
      verdict.ties += found == Match::tie;
      verdict.wrong += found == Match::wrong;
      if (found == Match::wrong && verdict.first_wrong.empty()) {
        const int32_t first = first_id(oracle, camera, pixel);
        const auto metres = [&](int32_t triangle) {
          const auto ray = camera.unproject(pixel);
          const auto hit = ray && triangle >= 0 ? oracle.meet(uint32_t(triangle), ray->direction) : std::nullopt;
          return hit ? fmt::format("at {:.6f} m", hit->distance) : std::string("not on the ray");
        };
        verdict.first_wrong = fmt::format("pixel ({}, {}) has triangle {} ({}), the oracle says {} ({})", x, y, id,
                                          metres(id), first, metres(first));
      }
    }
  }
  return verdict;
}

}  // namespace omma
