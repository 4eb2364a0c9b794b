#include "omma/visibility/ray_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

/// Cones are this much wider, radians: more than what single precision takes off a dot product of unit vectors.
constexpr double slack = 2e-6;
constexpr double widest_cos = 0.17;

/// Around `count` directions, of which some may be zero.
class ConeFitter {
 public:
  void add(const glm::vec3& direction) { sum_ += glm::dvec3(direction); }
  /// The axis is known once all directions have been added; then each widens the cone.
  void fix_axis() {
    const double length = glm::length(sum_);
    axis_ = length > 1e-3 ? glm::vec3(sum_ / length) : glm::vec3(0.0f);
  }
  void widen(const glm::vec3& direction) {
    if (direction == glm::vec3(0.0f)) return;
    const glm::dvec3 axis(axis_), d(direction);
    if (glm::dot(axis, d) < widest_cos) wide_ = true;
    sin_ = std::max(sin_, glm::length(glm::cross(axis, d)));
  }
  Cone cone() const {
    if (wide_) return {};
    const double angle = std::asin(std::min(1.0, sin_)) + slack;
    return {axis_, float(std::sin(angle)), float(std::cos(angle))};
  }

 private:
  glm::dvec3 sum_{0.0};
  glm::vec3 axis_{0.0f};
  double sin_ = 0.0;
  bool wide_ = false;
};

template <typename Each>
void each_ray(const RayBlock& block, int leaf, const Each& each) {
  for (int ray = 0; ray < 16; ++ray) each({block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]});
}

/// False when there is no ray.
bool fill(const RayMap& rays, RayBlock& block) {
  block.leaf_mask = 0;
  ConeFitter whole;
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    ConeFitter part;
    for (int ray = 0; ray < 16; ++ray) {
      const int x = block.pixel_x + RayBlock::x_of(leaf, ray), y = block.pixel_y + RayBlock::y_of(leaf, ray);
      const bool inside = x < rays.size.width && y < rays.size.height;
      const glm::vec3 d = inside ? rays.directions[size_t(y) * size_t(rays.size.width) + size_t(x)] : glm::vec3(0.0f);
      block.x[leaf][ray] = d.x;
      block.y[leaf][ray] = d.y;
      block.z[leaf][ray] = d.z;
      if (d != glm::vec3(0.0f)) block.leaf_mask |= 1u << leaf;
      part.add(d);
      whole.add(d);
    }
    part.fix_axis();
    each_ray(block, leaf, [&](const glm::vec3& d) { part.widen(d); });
    const Cone cone = part.cone();
    block.axis_x[leaf] = cone.axis.x;
    block.axis_y[leaf] = cone.axis.y;
    block.axis_z[leaf] = cone.axis.z;
    block.sin[leaf] = cone.sin;
    block.cos[leaf] = cone.cos;
  }
  if (block.leaf_mask == 0) return false;
  whole.fix_axis();
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    each_ray(block, leaf, [&](const glm::vec3& d) { whole.widen(d); });
  }
  block.cone = whole.cone();
  return true;
}

}  // namespace

RayTree::RayTree(const RayMap& rays) : size_(rays.size) {
  const int across = (size_.width + RayBlock::side - 1) / RayBlock::side;
  const int down = (size_.height + RayBlock::side - 1) / RayBlock::side;
  std::vector<std::vector<RayBlock>> rows(static_cast<size_t>(down));
  tbb::parallel_for(0, down, [&](int row) {
    for (int column = 0; column < across; ++column) {
      RayBlock block;
      block.pixel_x = column * RayBlock::side;
      block.pixel_y = row * RayBlock::side;
      if (fill(rays, block)) rows[size_t(row)].push_back(block);
    }
  });
  size_t count = 0;
  for (const auto& row : rows) count += row.size();
  blocks_.reserve(count);
  for (const auto& row : rows) blocks_.insert(blocks_.end(), row.begin(), row.end());
}

}  // namespace omma
