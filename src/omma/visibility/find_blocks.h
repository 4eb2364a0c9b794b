// The finder's inner part, compiled for every SIMD target: what the rays of blocks meet.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "omma/visibility/placed_scene.h"
#include "omma/visibility/ray_hit.h"
#include "omma/visibility/ray_tree.h"

namespace omma {

/// What the rays of one block meet, in the order of the block's rays. Larger is nearer, 0 is nothing.
struct alignas(64) BlockPicture {
  float inverse_distance[RayBlock::leaves][16];
  uint32_t triangle[RayBlock::leaves][16], instance[RayBlock::leaves][16];
};

/// A blended surface on a ray of a block.
struct BlockLayer {
  uint32_t leaf, ray;
  RayHit hit;
};

struct BlockQuery {
  const PlacedScene* scene = nullptr;
  Solid solid = Solid::opaque;
  /// Looks for all blended surfaces nearer than what `picture` holds instead.
  bool collect = false;
};

/// Called for a block with what its rays meet.
using BlockSink = std::function<void(const RayBlock&, const BlockPicture&, std::span<const BlockLayer>)>;
/// Fills the nearest inverse distances in before the search that collects.
using BlockSource = std::function<void(const RayBlock&, BlockPicture&)>;

/// On one thread, by the best SIMD target of this processor. `origins` is empty or as long as `blocks`.
void find_blocks(const BlockQuery& query, std::span<const RayBlock> blocks, std::span<const BlockOrigins> origins,
                 const BlockSource& source, const BlockSink& sink);

/// The SIMD instruction sets that this processor can find with, the best first: that one is used. Those with fused
/// multiplication and addition agree to the bit, and so do those without.
std::vector<std::string> simd_targets();
/// Throws CommandError when it is none of them. An empty name means the best again. For tests and benchmarks, while
/// nothing is being found.
void use_simd_target(const std::string& name);

}  // namespace omma
