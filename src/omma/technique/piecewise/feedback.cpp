#include "omma/technique/piecewise/blended_replicas.h"
#include "omma/technique/piecewise/feedback_lists.h"
#include "omma/technique/piecewise/piece_drawer.h"

namespace omma {
namespace {

class FeedbackDrawer : public PieceDrawer {
 public:
  explicit FeedbackDrawer(DrawTools& tools) : tools_(tools), clusters_(tools.scene), lists_(tools), blended_(tools) {}

  void scene_changed(const SceneChanges& changes) override {
    if (clusters_.update(changes)) lists_.forget();
  }
  size_t buffer_bytes() const override { return clusters_.bytes() + lists_.bytes() + blended_.bytes(); }

  void draw(const View& view, const GpuPieces& pieces) override {
    draw_solid(view, pieces);
    if (!view.labels() && tools_.scene.has_blending()) blended_.draw(view, pieces, clusters_);
  }

 private:
  void draw_solid(const View& view, const GpuPieces& pieces) {
    clusters_.narrow(tools_, pieces);
    lists_.update(pieces, clusters_);
    tools_.timer.mark("draw");
    const PieceClipping clipping;
    const SurfaceState state(tools_, false);
    pieces.bind();
    clusters_.bind();
    lists_.bind();
    MeshPass pass = replica_pass(pieces, {{GL_VERTEX_SHADER, "technique/piecewise/feedback_draw.vert"},
                                          {GL_GEOMETRY_SHADER, "technique/piecewise/expand.geom"}});
    pass.defines["MAX_RUNS"] = std::to_string(FeedbackLists::max_runs);
    pass.defines["PIECES_A_POINT"] = "1";
    for (size_t i = 0; i < clusters_.groups().size(); ++i) {
      const ClusterGroup& group = clusters_.groups()[i];
      if (group.blended && !view.labels()) continue;
      use_material(tools_, pass, view, group.material, group.mirrored);
      lists_.draw(i);
    }
  }

  DrawTools& tools_;
  SceneClusters clusters_;
  FeedbackLists lists_;
  BlendedReplicas blended_;
};

}  // namespace

std::unique_ptr<PieceDrawer> make_feedback_drawer(DrawTools& tools) { return std::make_unique<FeedbackDrawer>(tools); }

}  // namespace omma
