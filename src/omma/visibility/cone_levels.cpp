#include "omma/visibility/cone_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double slack = 2e-6;       ///< radians; what single precision takes off the cones, and more
constexpr double widest_cos = 0.17;  ///< as Cone says: less than 80°

bool is_everything(const Cone& cone) { return cone.axis == glm::vec3(0.0f); }

}  // namespace

Cone cone_around(std::span<const Cone> cones) {
  glm::dvec3 sum(0.0);
  for (const Cone& cone : cones) {
    if (is_everything(cone)) return {};
    sum += glm::dvec3(cone.axis);
  }
  if (glm::length(sum) < 1e-3) return {};
  const glm::vec3 axis(glm::normalize(sum));
  double angle = 0.0;
  for (const Cone& cone : cones) {
    const glm::dvec3 a(axis), b(cone.axis);
    const double apart = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    angle = std::max(angle, apart + std::atan2(double(cone.sin), double(cone.cos)));
  }
  angle += slack;
  if (angle >= std::acos(widest_cos)) return {};
  return {axis, float(std::sin(angle)), float(std::cos(angle))};
}

ConeLevels::ConeLevels(const RayTree& rays) {
  const auto block_count = uint32_t(rays.blocks().size());
  cones.resize(size_t(block_count) * (RayBlock::leaves + 1));
  levels = {{0, block_count * RayBlock::leaves}, {block_count * RayBlock::leaves, block_count}};
  tbb::parallel_for(uint32_t{0}, block_count, [&](uint32_t i) {
    const RayBlock& block = rays.blocks()[i];
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      cones[i * RayBlock::leaves + uint32_t(leaf)] = block.leaf_cone(leaf);
    }
    cones[levels[1].first + i] = block.cone;
  });
  while (levels.back().count > most_at_top) {
    const Level below = levels.back();
    const Level level{below.first + below.count, (below.count + 15) / 16};
    cones.resize(level.first + level.count);
    for (uint32_t i = 0; i < level.count; ++i) {
      const uint32_t first = below.first + 16 * i, count = std::min(16u, below.count - 16 * i);
      cones[level.first + i] = cone_around(std::span<const Cone>(cones).subspan(first, count));
    }
    levels.push_back(level);
  }
}

}  // namespace omma
