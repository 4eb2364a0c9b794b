// The triangles of blended materials as a list for the Replicator.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "omma/technique/gpu_scene.h"

namespace omma {

struct BlendedItems {
  std::vector<uint32_t> items;     ///< part << 10 | triangle, the farthest first
  std::vector<glm::uvec2> ranges;  ///< of items that follow each other in one part, the last one excluded
  std::vector<size_t> parts;       ///< of each range
};

BlendedItems blended_items(const GpuScene& scene);

}  // namespace omma
