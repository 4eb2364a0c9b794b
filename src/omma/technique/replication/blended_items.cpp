#include "omma/technique/replication/blended_items.h"

#include "omma/technique/mesh_pass.h"

namespace omma {

BlendedItems blended_items(const GpuScene& scene) {
  BlendedItems blended;
  for (const BlendedTriangle& triangle : blended_triangles(scene, [](const Bounds&) { return true; })) {
    if (blended.parts.empty() || blended.parts.back() != triangle.part) {
      blended.parts.push_back(triangle.part);
      blended.ranges.emplace_back(blended.items.size(), blended.items.size());
    }
    blended.items.push_back(uint32_t(triangle.part) << 10 | triangle.number);
    blended.ranges.back().y = uint32_t(blended.items.size());
  }
  return blended;
}

}  // namespace omma
