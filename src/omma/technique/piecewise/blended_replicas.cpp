#include "omma/technique/piecewise/blended_replicas.h"

#include "omma/technique/replication/blended_items.h"

namespace omma {

void BlendedReplicas::draw(const View& view, const GpuPieces& pieces, const SceneClusters& clusters) {
  const BlendedItems blended = blended_items(tools_.scene);
  if (blended.items.empty()) return;
  replicator_.replicate_items(pieces, clusters, blended.items);
  replicator_.prepare_draws(blended.ranges);

  tools_.timer.mark("draw");
  const PieceClipping clipping;
  const SurfaceState state(tools_, true);
  replicator_.bind();
  const MeshPass pass = replica_pass(pieces, {{GL_VERTEX_SHADER, "technique/piecewise/replica.vert"}});
  for (size_t i = 0; i < blended.ranges.size(); ++i) {
    const Part& part = tools_.scene.parts()[blended.parts[i]];
    use_material(tools_, pass, view, part.material, part.mirrored);
    replicator_.draw(i);
  }
}

}  // namespace omma
