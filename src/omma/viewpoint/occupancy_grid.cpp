#include "omma/viewpoint/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omma {
namespace {

constexpr int longest = 128;                   // cells along the longest side
constexpr int layers = 64;                     // of cells that are lower than wide
constexpr size_t most_triangles = 10'000'000;  // of more a sample will do

}  // namespace

OccupancyGrid::OccupancyGrid(const Scene& scene, const Bounds& bounds) : origin_(bounds.min) {
  const glm::dvec3 extent = bounds.extent();
  const double size = std::max({extent.x, extent.y, extent.z});
  const double width = size > 0.0 ? size / longest : 1.0;
  cell_ = {width, std::clamp(extent.y / layers, 0.01 * width, width), width};
  size_ = glm::ivec3(glm::floor(extent / cell_)) + 1;
  sides_.assign(size_t(size_.x) * size_t(size_.y) * size_t(size_.z), 0);
  const size_t step = 1 + scene.triangle_count() / most_triangles;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat3 axes(instance.worldFromObject);
    const glm::mat3 cellsFromObject(axes[0] / cell_, axes[1] / cell_, axes[2] / cell_);
    const glm::vec3 shift((glm::dvec3(instance.worldFromObject[3]) - origin_) / cell_);
    const bool mirrored = glm::determinant(axes) < 0.0;
    for (size_t i = 0; i < mesh.triangles.size(); i += step) {
      const glm::uvec3& t = mesh.triangles[i];
      const glm::vec3 a = cellsFromObject * mesh.positions[t.x] + shift;
      const glm::vec3 b = cellsFromObject * mesh.positions[mirrored ? t.z : t.y] + shift;
      const glm::vec3 c = cellsFromObject * mesh.positions[mirrored ? t.y : t.z] + shift;
      add(a, b, c);
    }
  }
}

void OccupancyGrid::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 least = glm::max(glm::min(glm::min(a, b), c), glm::vec3(0.0f));
  const glm::vec3 most = glm::min(glm::max(glm::max(a, b), c), glm::vec3(size_));
  if (!(least.x <= most.x && least.y <= most.y && least.z <= most.z)) return;

  const glm::vec3 normal = glm::cross(b - a, c - a), metric = normal / glm::vec3(cell_);
  const float slanted = 0.3f * glm::length(metric);
  uint8_t seen = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (metric[axis] > slanted) seen |= side(axis, true);
    if (metric[axis] < -slanted) seen |= side(axis, false);
  }
  const glm::ivec3 last = size_ - 1;
  const auto mark = [&](const glm::vec3& p) { sides_[index(glm::clamp(glm::ivec3(p), glm::ivec3(0), last))] |= seen; };
  mark(0.5f * (least + most));  // one that is smaller than a cell has its middle here
  const glm::vec3 reach = most - least;
  if (std::max({reach.x, reach.y, reach.z}) < 0.7f) return;

  // Looking along the axis that it faces most, a cell for each column whose middle it covers: then no way from cell to
  // neighbouring cell leads through.
  const glm::vec3 faces = glm::abs(normal);
  const int k = faces.x > faces.y ? (faces.x > faces.z ? 0 : 2) : (faces.y > faces.z ? 1 : 2);
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  if (normal[k] == 0.0f) return;
  const float by_area = 1.0f / normal[k], along_i = -normal[i] * by_area, along_j = -normal[j] * by_area;
  const auto outside = [&](const glm::vec3& p, const glm::vec3& q, float u, float v) {
    return ((q[i] - p[i]) * (v - p[j]) - (q[j] - p[j]) * (u - p[i])) * by_area < 0.0f;
  };
  for (float v = std::floor(least[j]) + 0.5f; v < most[j] + 0.5f; v += 1.0f) {
    for (float u = std::floor(least[i]) + 0.5f; u < most[i] + 0.5f; u += 1.0f) {
      if (outside(a, b, u, v) || outside(b, c, u, v) || outside(c, a, u, v)) continue;
      glm::vec3 p;
      p[i] = u;
      p[j] = v;
      p[k] = a[k] + along_i * (u - a[i]) + along_j * (v - a[j]);
      if (p[k] >= 0.0f && p[k] < float(size_[k])) mark(p);
    }
  }
}

OccupancyGrid::Sight OccupancyGrid::look(const glm::dvec3& from, const glm::dvec3& direction) const {
  // From cell to cell, as Amanatides and Woo go.
  const glm::dvec3 start = (from - origin_) / cell_, speed = direction / cell_;
  glm::ivec3 at = glm::ivec3(glm::floor(start)), step;
  glm::dvec3 next, each;
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = speed[axis] > 0.0 ? 1 : -1;
    const double border = at[axis] + (speed[axis] > 0.0 ? 1.0 : 0.0);
    const bool moves = std::abs(speed[axis]) > 1e-12;
    each[axis] = moves ? 1.0 / std::abs(speed[axis]) : std::numeric_limits<double>::infinity();
    next[axis] = moves ? (border - start[axis]) / speed[axis] : std::numeric_limits<double>::infinity();
  }
  for (;;) {
    const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const double distance = next[axis];
    at[axis] += step[axis];
    next[axis] += each[axis];
    if (!contains(at)) return {distance, false, false};
    const uint8_t sides = sides_[index(at)];
    if (sides == 0) continue;
    double facing = 0.0;  // both sides of a thin wall, or of what is turned many ways: 0
    for (int i = 0; i < 3; ++i) {
      facing -= direction[i] * (int((sides & side(i, true)) != 0) - int((sides & side(i, false)) != 0));
    }
    return {distance, true, facing >= 0.0};
  }
}

}  // namespace omma
