#include "omma/visibility/finder.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace omma {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr size_t blocks_at_once = 16;

/// Calls `each(leaf, ray, pixel)` for the rays of a block that lie within the image.
template <typename Each>
void each_pixel(const RayBlock& block, ImageSize size, const Each& each) {
  const bool whole = block.pixel_x + RayBlock::side <= size.width && block.pixel_y + RayBlock::side <= size.height;
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    const int x0 = block.pixel_x + RayBlock::x_of(leaf, 0), y0 = block.pixel_y + RayBlock::y_of(leaf, 0);
    for (int row = 0; row < RayBlock::leaf_side; ++row) {
      const size_t first = size_t(y0 + row) * size_t(size.width) + size_t(x0);
      const int ray = row * RayBlock::leaf_side;
      for (int i = 0; i < RayBlock::leaf_side; ++i) {
        if (whole || (x0 + i < size.width && y0 + row < size.height)) each(leaf, ray + i, first + size_t(i));
      }
    }
  }
}

/// Calls `each(first pixel, count)` for the rows of what the image has no rays in.
template <typename Each>
void each_blank_row(const RayTree& rays, const Each& each) {
  const int width = rays.size().width, height = rays.size().height;
  tbb::parallel_for(size_t{0}, rays.blank().size(), [&](size_t i) {
    const glm::ivec2 corner = rays.blank()[i];
    for (int y = corner.y; y < std::min(corner.y + RayBlock::side, height); ++y) {
      each(size_t(y) * size_t(width) + size_t(corner.x), size_t(std::min(RayBlock::side, width - corner.x)));
    }
  });
}

/// Calls `each(squares)`, on several threads at once, for some of the rays after the others.
template <typename Each>
void each_squares(const RaySource& rays, const Each& each) {
  const auto samples = size_t(rays.samples());
  tbb::enumerable_thread_specific<RayRoom> rooms;
  const size_t at_once = std::max<size_t>(1, blocks_at_once / samples);
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, rays.squares(), at_once),
      [&](const tbb::blocked_range<size_t>& range) { each(rays.some(range.begin(), range.size(), rooms.local())); },
      tbb::simple_partitioner{});  // no more at once than the caches hold
}

void find(const RaySource& rays, const BlockQuery& query, const BlockSource& source, const BlockSink& sink) {
  each_squares(rays, [&](const RaySquares& some) { find_blocks(query, some.blocks, some.origins, source, sink); });
}

}  // namespace

void Finder::each_block(const RaySource& rays, Solid solid,
                        const std::function<void(const RayBlock&, const BlockPicture&)>& each) const {
  const BlockQuery query{.scene = &scene_, .solid = solid};
  find(rays, query, {}, [&](const RayBlock& block, const BlockPicture& picture, std::span<const BlockLayer>) {
    if (block.leaf_mask != 0) each(block, picture);
  });
}

void Finder::each_square(const RaySource& rays, const std::function<void(std::span<const FoundBlock>)>& each) const {
  const auto samples = size_t(rays.samples());
  const BlockQuery opaque{.scene = &scene_}, blended{.scene = &scene_, .collect = true};
  tbb::enumerable_thread_specific<std::vector<FoundBlock>> rooms;
  each_squares(rays, [&](const RaySquares& some) {
    std::vector<FoundBlock>& room = rooms.local();
    if (room.size() < some.blocks.size()) room.resize(some.blocks.size());
    const std::span<FoundBlock> found(room.data(), some.blocks.size());
    const auto found_of = [&](const RayBlock& block) -> FoundBlock& {
      return found[size_t(&block - some.blocks.data())];
    };
    find_blocks(opaque, some.blocks, some.origins, {},
                [&](const RayBlock& block, const BlockPicture& picture, std::span<const BlockLayer>) {
                  found_of(block).block = &block;
                  found_of(block).picture = picture;
                  found_of(block).layers.clear();
                });
    if (scene_.index().has_blending()) {
      find_blocks(
          blended, some.blocks, some.origins,
          [&](const RayBlock& block, BlockPicture& picture) { picture = found_of(block).picture; },
          [&](const RayBlock& block, const BlockPicture&, std::span<const BlockLayer> layers) {
            found_of(block).layers.assign(layers.begin(), layers.end());
          });
    }
    for (size_t i = 0; i < found.size(); i += samples) {
      const std::span<FoundBlock> square = found.subspan(i, samples);
      for (FoundBlock& sample : square) sample.border = &some.borders[i / samples];
      const auto has_rays = [](const FoundBlock& sample) { return sample.block->leaf_mask != 0; };
      if (std::ranges::any_of(square, has_rays)) each(square);
    }
  });
}

void Finder::nearest(const RayTree& rays, Solid solid, std::span<glm::uvec2> triangles,
                     std::span<float> distances) const {
  each_blank_row(rays, [&](size_t first, size_t count) {
    std::fill_n(&triangles[first], count, glm::uvec2(meets_nothing, no_ray));
    if (!distances.empty()) std::fill_n(&distances[first], count, infinity);
  });
  each_block(rays, solid, [&](const RayBlock& block, const BlockPicture& picture) {
    each_pixel(block, rays.size(), [&](int leaf, int ray, size_t pixel) {
      triangles[pixel] = {picture.triangle[leaf][ray], picture.instance[leaf][ray]};
      if (distances.empty()) return;
      const bool hit = picture.triangle[leaf][ray] != meets_nothing;
      distances[pixel] = hit ? 1.0f / picture.inverse_distance[leaf][ray] : infinity;
    });
  });
}

std::vector<std::vector<RayHit>> Finder::blended(const RayTree& rays, std::span<const float> distances) const {
  std::vector<std::vector<RayHit>> found(distances.size());
  const auto limit = [&](const RayBlock& block, BlockPicture& picture) {
    std::fill_n(&picture.inverse_distance[0][0], RayBlock::leaves * 16, infinity);
    each_pixel(block, rays.size(), [&](int leaf, int ray, size_t pixel) {
      if (block.rays[leaf] >> ray & 1) picture.inverse_distance[leaf][ray] = 1.0f / distances[pixel];
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
