#include "omma/technique/piecewise/blended_replicas.h"
#include "omma/technique/piecewise/piece_drawer.h"

namespace omma {
namespace {

class ComputeDrawer : public PieceDrawer {
 public:
  explicit ComputeDrawer(DrawTools& tools) : tools_(tools), clusters_(tools.scene), solid_(tools), blended_(tools) {}

  void scene_changed() override { clusters_.update(); }

  void draw(const View& view, const GpuPieces& pieces) override {
    draw_solid(view, pieces);
    if (!view.labels() && tools_.scene.has_blending()) blended_.draw(view, pieces, clusters_);
  }

  size_t buffer_bytes() const override { return clusters_.bytes() + solid_.bytes() + blended_.bytes(); }

 private:
  void draw_solid(const View& view, const GpuPieces& pieces) {
    std::vector<const ClusterGroup*> groups;
    std::vector<glm::uvec2> ranges;
    for (const ClusterGroup& group : clusters_.groups()) {
      if (group.blended && !view.labels()) continue;
      groups.push_back(&group);
      ranges.push_back(SceneClusters::cluster_triangles * glm::uvec2(group.first_cluster, group.last_cluster));
    }
    if (groups.empty()) return;
    solid_.replicate_clusters(pieces, clusters_, groups.back()->last_cluster);
    solid_.prepare_draws(ranges);

    tools_.timer.mark("draw");
    const PieceClipping clipping;
    const SurfaceState state(tools_, false);
    solid_.bind();
    const MeshPass pass = replica_pass(pieces, {{GL_VERTEX_SHADER, "technique/piecewise/replica.vert"}});
    for (size_t i = 0; i < groups.size(); ++i) {
      use_material(tools_, pass, view, groups[i]->material, groups[i]->mirrored);
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
