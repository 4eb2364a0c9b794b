#include "omma/technique/piecewise/blended_replicas.h"

namespace omma {

void BlendedReplicas::draw(const View& view, const GpuPieces& pieces, const SceneClusters& clusters) {
  const std::vector<BlendedTriangle> triangles = blended_triangles(tools_.scene, [](const Bounds&) { return true; });
  std::vector<uint32_t> items;
  std::vector<glm::uvec2> ranges;
  std::vector<size_t> parts;
  for (const BlendedTriangle& triangle : triangles) {
    if (parts.empty() || parts.back() != triangle.part) {
      parts.push_back(triangle.part);
      ranges.emplace_back(items.size(), items.size());
    }
    items.push_back(uint32_t(triangle.part) << 10 | triangle.number);
    ranges.back().y = uint32_t(items.size());
  }
  if (items.empty()) return;
  replicator_.replicate_items(pieces, clusters, items);
  replicator_.prepare_draws(ranges);

  tools_.timer.mark("draw");
  const PieceClipping clipping;
  const SurfaceState state(tools_, true);
  glBindVertexArray(tools_.no_vertices.id());
  replicator_.bind();
  const MeshPass pass = replica_pass(pieces, {{GL_VERTEX_SHADER, "technique/piecewise/replica.vert"}});
  for (size_t i = 0; i < ranges.size(); ++i) {
    const Part& part = tools_.scene.parts()[parts[i]];
    use_material(tools_, pass, view, part.material, part.mirrored);
    replicator_.draw(i);
  }
}

}  // namespace omma
