#include "omma/visibility/ray_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "omma/base/error.h"

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

/// Zero beyond the image.
glm::vec3 direction_at(const RayMap& rays, int x, int y) {
  const bool inside = x >= 0 && y >= 0 && x < rays.size.width && y < rays.size.height;
  return inside ? rays.directions[size_t(y) * size_t(rays.size.width) + size_t(x)] : glm::vec3(0.0f);
}

/// False when there is no ray.
bool fill(const RayMap& rays, RayBlock& block) {
  block.leaf_mask = 0;
  ConeFitter whole;
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    ConeFitter part;
    block.rays[leaf] = 0;
    for (int ray = 0; ray < 16; ++ray) {
      const glm::vec3 d =
          direction_at(rays, block.pixel_x + RayBlock::x_of(leaf, ray), block.pixel_y + RayBlock::y_of(leaf, ray));
      block.x[leaf][ray] = d.x;
      block.y[leaf][ray] = d.y;
      block.z[leaf][ray] = d.z;
      if (d != glm::vec3(0.0f)) block.rays[leaf] = uint16_t(block.rays[leaf] | 1u << ray);
      part.add(d);
      whole.add(d);
    }
    if (block.rays[leaf] != 0) block.leaf_mask |= 1u << leaf;
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
  block.grid = fit_pixel_grid(block);
  return true;
}

SquareBorder border_of(const RayMap& rays, const RayBlock& block) {
  SquareBorder border;
  const auto put = [&](SquareBorder::Side side, int i, int x, int y) {
    const glm::vec3 d = direction_at(rays, block.pixel_x + x, block.pixel_y + y);
    border.x[side][i] = d.x;
    border.y[side][i] = d.y;
    border.z[side][i] = d.z;
  };
  for (int i = 0; i < RayBlock::side; ++i) {
    put(SquareBorder::left, i, -1, i);
    put(SquareBorder::right, i, RayBlock::side, i);
    put(SquareBorder::above, i, i, -1);
    put(SquareBorder::below, i, i, RayBlock::side);
  }
  return border;
}

void check(const RayMap& rays, std::span<const glm::vec3> origins) {
  if (!origins.empty() && origins.size() != rays.directions.size()) {
    throw CommandError("{} rays with {} origins; each has one, or none has", rays.directions.size(), origins.size());
  }
  for (const glm::vec3& origin : origins) {
    if (!(std::isfinite(origin.x) && std::isfinite(origin.y) && std::isfinite(origin.z))) {
      throw CommandError("a ray begins at {}, {}, {}, which is nowhere", origin.x, origin.y, origin.z);
    }
  }
}

/// Calls `each(leaf, ray, number of the ray)` for the rays that there are.
template <typename Each>
void each_ray_number(const RayBlock& block, ImageSize size, const Each& each) {
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      if (!(block.rays[leaf] >> ray & 1)) continue;
      const int x = block.pixel_x + RayBlock::x_of(leaf, ray), y = block.pixel_y + RayBlock::y_of(leaf, ray);
      each(leaf, ray, size_t(y) * size_t(size.width) + size_t(x));
    }
  }
}

void fill(ImageSize size, std::span<const glm::vec3> origins, const RayBlock& block, BlockOrigins& filled) {
  filled = {};
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  each_ray_number(block, size, [&](int, int, size_t number) {
    low = glm::min(low, glm::dvec3(origins[number]));
    high = glm::max(high, glm::dvec3(origins[number]));
  });
  filled.apex = glm::vec3(0.5 * (low + high));
  double radius = 0.0;
  each_ray_number(block, size, [&](int leaf, int ray, size_t number) {
    const glm::dvec3 offset = glm::dvec3(origins[number]) - glm::dvec3(filled.apex);
    const glm::dvec3 direction(block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]);
    const glm::dvec3 moment = glm::cross(offset, direction);
    filled.x[leaf][ray] = float(offset.x);
    filled.y[leaf][ray] = float(offset.y);
    filled.z[leaf][ray] = float(offset.z);
    filled.moment_x[leaf][ray] = float(moment.x);
    filled.moment_y[leaf][ray] = float(moment.y);
    filled.moment_z[leaf][ray] = float(moment.z);
    filled.along[leaf][ray] = float(glm::dot(offset, direction));
    radius = std::max(radius, glm::length(offset));
  });
  filled.radius = float(radius * (1.0 + slack));
}

/// The bits of both numbers by turns: Morton's order.
uint64_t interleaved(int x, int y) {
  uint64_t result = 0;
  for (int bit = 0; bit < 31; ++bit) {
    result |= uint64_t(x >> bit & 1) << (2 * bit) | uint64_t(y >> bit & 1) << (2 * bit + 1);
  }
  return result;
}

}  // namespace

RayTree::RayTree(const RayMap& rays, std::span<const glm::vec3> origins) : RayTree(std::span(&rays, 1)) {
  check(rays, origins);
  if (origins.empty()) return;
  origins_.resize(blocks_.size());
  tbb::parallel_for(size_t{0}, blocks_.size(), [&](size_t i) { fill(rays.size, origins, blocks_[i], origins_[i]); });
}

RayTree::RayTree(std::span<const RayMap> samples) : size_(samples.front().size), samples_(int(samples.size())) {
  const int across = (size_.width + RayBlock::side - 1) / RayBlock::side;
  const int down = (size_.height + RayBlock::side - 1) / RayBlock::side;
  std::vector<glm::ivec2> places;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) places.emplace_back(x, y);
  }
  // Blocks that are done one after another see the same triangles, while these are still in the processor's caches.
  std::sort(places.begin(), places.end(),
            [](const glm::ivec2& a, const glm::ivec2& b) { return interleaved(a.x, a.y) < interleaved(b.x, b.y); });
  const size_t count = samples.size();
  blocks_.resize(places.size() * count);
  std::vector<char> filled(places.size());
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    for (size_t s = 0; s < count; ++s) {
      RayBlock& block = blocks_[i * count + s];
      block.pixel_x = places[i].x * RayBlock::side;
      block.pixel_y = places[i].y * RayBlock::side;
      filled[i] |= char(fill(samples[s], block));
    }
  });
  size_t kept = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    if (filled[i]) {
      std::copy_n(blocks_.begin() + ptrdiff_t(i * count), count, blocks_.begin() + ptrdiff_t(kept));
      kept += count;
    } else {
      blank_.push_back(places[i] * RayBlock::side);
    }
  }
  blocks_.resize(kept);
  borders_.resize(kept / count);
  tbb::parallel_for(size_t{0}, borders_.size(),
                    [&](size_t i) { borders_[i] = border_of(samples.front(), blocks_[i * count]); });
}

}  // namespace omma
