#include "omma/technique/piecewise/blended_replicas.h"
#include "omma/technique/piecewise/piece_drawer.h"

namespace omma {
namespace {

class ComputeDrawer : public PieceDrawer {
 public:
  explicit ComputeDrawer(DrawTools& tools) : tools_(tools), clusters_(tools.scene), solid_(tools), blended_(tools) {}

  void scene_changed(const SceneChanges& changes) override { clusters_.update(changes); }

  void draw(const View& view, const GpuPieces& pieces) override {
    draw_solid(view, pieces);
    if (!view.labels() && tools_.scene.has_blending()) blended_.draw(view, pieces, clusters_);
  }

  size_t buffer_bytes() const override { return clusters_.bytes() + solid_.bytes() + blended_.bytes(); }

 private:
  void draw_solid(const View& view, const GpuPieces& pieces) {
    const DrawnGroups drawn = clusters_.unordered(view.labels());
    if (drawn.groups.empty()) return;
    solid_.replicate_clusters(pieces, clusters_, drawn.clusters);
    solid_.prepare_draws(drawn.ranges);

    tools_.timer.mark("draw");
    const PieceClipping clipping;
    const SurfaceState state(tools_, false);
    solid_.bind();
    const MeshPass pass = replica_pass(pieces, {{GL_VERTEX_SHADER, "technique/piecewise/replica.vert"}});
    for (size_t i = 0; i < drawn.groups.size(); ++i) {
      use_material(tools_, pass, view, drawn.groups[i].material, drawn.groups[i].mirrored);
      solid_.draw(i);
    }
  }

  DrawTools& tools_;
  SceneClusters clusters_;
  Replicator solid_;
  BlendedReplicas blended_;
};

}  // namespace

std::unique_ptr<PieceDrawer> make_compute_drawer(DrawTools& tools) { return std::make_unique<ComputeDrawer>(tools); }

}  // namespace omma
