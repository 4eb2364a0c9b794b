#include "omma/visibility/finder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "omma/visibility/find_blocks.h"

namespace omma {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr size_t blocks_at_once = 8;

/// Calls `each(leaf, ray, pixel)` for the rays of a block that lie within the image.
template <typename Each>
void each_pixel(const RayBlock& block, ImageSize size, const Each& each) {
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      const int x = block.pixel_x + RayBlock::x_of(leaf, ray), y = block.pixel_y + RayBlock::y_of(leaf, ray);
      if (x < size.width && y < size.height) each(leaf, ray, size_t(y) * size_t(size.width) + size_t(x));
    }
  }
}

void find(const RayTree& rays, const BlockQuery& query, const BlockSource& source, const BlockSink& sink) {
  const std::span<const RayBlock> blocks(rays.blocks());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, blocks.size(), blocks_at_once),
                    [&](const tbb::blocked_range<size_t>& range) {
                      find_blocks(query, blocks.subspan(range.begin(), range.size()), source, sink);
                    });
}

}  // namespace

void Finder::nearest(const RayTree& rays, Solid solid, std::span<glm::uvec2> triangles,
                     std::span<float> distances) const {
  std::fill(triangles.begin(), triangles.end(), glm::uvec2(meets_nothing, no_ray));
  std::fill(distances.begin(), distances.end(), infinity);
  const BlockQuery query{.scene = &scene_, .solid = solid};
  find(rays, query, {}, [&](const RayBlock& block, const BlockPicture& picture, std::span<const BlockLayer>) {
    each_pixel(block, rays.size(), [&](int leaf, int ray, size_t pixel) {
      triangles[pixel] = {picture.triangle[leaf][ray], picture.instance[leaf][ray]};
      if (!distances.empty() && picture.triangle[leaf][ray] != meets_nothing) {
        distances[pixel] = 1.0f / picture.inverse_distance[leaf][ray];
      }
    });
  });
}

std::vector<std::vector<RayHit>> Finder::blended(const RayTree& rays, std::span<const float> distances) const {
  std::vector<std::vector<RayHit>> found(distances.size());
  const auto limit = [&](const RayBlock& block, BlockPicture& picture) {
    std::fill_n(&picture.inverse_distance[0][0], RayBlock::leaves * 16, infinity);
    each_pixel(block, rays.size(), [&](int leaf, int ray, size_t pixel) {
      const bool is_ray = block.x[leaf][ray] != 0.0f || block.y[leaf][ray] != 0.0f || block.z[leaf][ray] != 0.0f;
      if (is_ray) picture.inverse_distance[leaf][ray] = 1.0f / distances[pixel];
    });
  };
  const BlockQuery query{.scene = &scene_, .collect = true};
  find(rays, query, limit, [&](const RayBlock& block, const BlockPicture&, std::span<const BlockLayer> layers) {
    for (const BlockLayer& layer : layers) {
      const int x = block.pixel_x + RayBlock::x_of(int(layer.leaf), int(layer.ray));
      const int y = block.pixel_y + RayBlock::y_of(int(layer.leaf), int(layer.ray));
      found[size_t(y) * size_t(rays.size().width) + size_t(x)].push_back(layer.hit);
    }
  });
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t pixel) {
    std::sort(found[pixel].begin(), found[pixel].end(), [](const RayHit& a, const RayHit& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
    });
  });
  return found;
}

}  // namespace omma
