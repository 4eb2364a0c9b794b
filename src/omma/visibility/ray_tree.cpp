#include "omma/visibility/ray_tree.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "omma/base/error.h"
#include "omma/visibility/make_blocks.h"

namespace omma {
namespace {

/// What a radius is widened by, relatively: more than single precision takes off it.
constexpr double slack = 2e-6;

/// Zero beyond the image.
glm::vec3 direction_at(const RayMap& rays, int x, int y) {
  const bool inside = x >= 0 && y >= 0 && x < rays.size.width && y < rays.size.height;
  return inside ? rays.directions[size_t(y) * size_t(rays.size.width) + size_t(x)] : glm::vec3(0.0f);
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

std::vector<glm::ivec2> squares_of(ImageSize size) {
  const int across = (size.width + RayBlock::side - 1) / RayBlock::side;
  const int down = (size.height + RayBlock::side - 1) / RayBlock::side;
  // Squares that are done one after another see the same triangles, while these are still in the processor's caches.
  std::vector<std::pair<uint64_t, glm::ivec2>> places;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) places.emplace_back(interleaved(x, y), glm::ivec2(x, y) * RayBlock::side);
  }
  std::ranges::sort(places, {}, &std::pair<uint64_t, glm::ivec2>::first);
  std::vector<glm::ivec2> squares;
  for (const auto& [number, place] : places) squares.push_back(place);
  return squares;
}

RayTree::RayTree(const RayMap& rays, std::span<const glm::vec3> origins) : size_(rays.size) {
  check(rays, origins);
  const std::vector<glm::ivec2> places = squares_of(size_);
  blocks_.resize(places.size());
  std::vector<char> filled(places.size());
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    blocks_[i].pixel_x = places[i].x;
    blocks_[i].pixel_y = places[i].y;
    put_rays([&](int x, int y) { return direction_at(rays, places[i].x + x, places[i].y + y); }, blocks_[i]);
    filled[i] = char(finish_block(blocks_[i]));
  });
  keep(filled);
  borders_.resize(blocks_.size());
  origins_.resize(origins.empty() ? 0 : blocks_.size());
  tbb::parallel_for(size_t{0}, blocks_.size(), [&](size_t i) {
    const glm::ivec2 first(blocks_[i].pixel_x, blocks_[i].pixel_y);
    put_border([&](int x, int y) { return direction_at(rays, first.x + x, first.y + y); }, borders_[i]);
    if (!origins.empty()) fill(rays.size, origins, blocks_[i], origins_[i]);
  });
}

RayTree::RayTree(const RaySource& source) : size_(source.size()), samples_(source.samples()) {
  const size_t squares = source.squares(), count = size_t(samples_);
  blocks_.resize(squares * count);
  borders_.resize(squares);
  std::vector<char> filled(squares);
  constexpr size_t at_once = 16;
  tbb::enumerable_thread_specific<RayRoom> rooms;
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, squares, at_once),
      [&](const tbb::blocked_range<size_t>& range) {
        const RaySquares made = source.some(range.begin(), range.size(), rooms.local());
        std::ranges::copy(made.blocks, blocks_.begin() + ptrdiff_t(range.begin() * count));
        std::ranges::copy(made.borders, borders_.begin() + ptrdiff_t(range.begin()));
        for (size_t i = 0; i < made.blocks.size(); ++i) {
          filled[range.begin() + i / count] |= char(made.blocks[i].leaf_mask != 0);
        }
      },
      tbb::simple_partitioner{});
  keep(filled);
}

/// Only the squares that are `filled`.
void RayTree::keep(std::span<const char> filled) {
  const auto count = size_t(samples_);
  // A source may leave out what it knows to be blank.
  const int across = (size_.width + RayBlock::side - 1) / RayBlock::side;
  const int down = (size_.height + RayBlock::side - 1) / RayBlock::side;
  std::vector<char> is_blank(size_t(across) * size_t(down), 1);
  size_t kept = 0;
  for (size_t i = 0; i < filled.size(); ++i) {
    const RayBlock& first = blocks_[i * count];
    if (!filled[i]) continue;
    is_blank[size_t(first.pixel_y / RayBlock::side * across + first.pixel_x / RayBlock::side)] = 0;
    std::copy_n(blocks_.begin() + ptrdiff_t(i * count), count, blocks_.begin() + ptrdiff_t(kept * count));
    if (!borders_.empty()) borders_[kept] = borders_[i];
    ++kept;
  }
  blocks_.resize(kept * count);
  if (!borders_.empty()) borders_.resize(kept);
  for (int i = 0; i < across * down; ++i) {
    if (is_blank[size_t(i)]) blank_.push_back(RayBlock::side * glm::ivec2(i % across, i / across));
  }
}

RaySquares RayTree::some(size_t first, size_t count, RayRoom&) const {
  const auto samples = size_t(samples_);
  const auto part = [&](const auto& of_blocks) {
    return std::span(of_blocks).subspan(first * samples, count * samples);
  };
  RaySquares squares{part(blocks_), std::span(borders_).subspan(first, count)};
  if (!origins_.empty()) squares.origins = part(origins_);
  return squares;
}

}  // namespace omma
