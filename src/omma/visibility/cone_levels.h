// Levels of cones above a ray tree's leaves, sixteen nodes under each, up to a few at the top: for finders that go down
// from cones around large parts of the image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "omma/visibility/ray_tree.h"

namespace omma {

/// A cone around all of these.
Cone cone_around(std::span<const Cone> cones);

struct ConeLevels {
  struct Level {
    uint32_t first, count;  ///< of `cones`
  };
  static constexpr uint32_t most_at_top = 16;

  /// Runs on all cores.
  explicit ConeLevels(const RayTree& rays);

  std::vector<Cone> cones;    ///< a level's n-th node encloses the 16 n-th to 16 n + 15-th of the level before it
  std::vector<Level> levels;  ///< leaves, blocks, sixteen consecutive blocks, …, at most `most_at_top` at last
};

}  // namespace omma
