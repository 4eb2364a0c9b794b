#include "omma/technique/nonlinear/bound_drawer.h"
#include "omma/technique/nonlinear/image_tiles.h"
#include "omma/technique/replication/blended_items.h"
#include "omma/technique/replication/replicator.h"
#include "omma/technique/replication/scene_clusters.h"

namespace omma {
namespace {

class HybridDrawer : public BoundDrawer {
 public:
  explicit HybridDrawer(DrawTools& tools)
      : tools_(tools),
        clusters_(tools.scene),
        solid_(tools, ReplicaShape::hexagon),
        blended_(tools, ReplicaShape::hexagon) {}

  void scene_changed() override { clusters_.update(); }
  size_t buffer_bytes() const override {
    return tiles_.bytes() + clusters_.bytes() + solid_.bytes() + blended_.bytes();
  }

  void draw(const View& view, const ExactStage& exact) override {
    tools_.timer.mark("tiles");
    tiles_.set(view);
    const MeshPass pass = exact.pass(view, {{GL_VERTEX_SHADER, "technique/nonlinear/bound.vert"}});
    draw_solid(view, pass);
    if (!view.labels() && tools_.scene.has_blending()) draw_blended(view, pass);
  }

 private:
  void draw_solid(const View& view, const MeshPass& pass) {
    std::vector<const ClusterGroup*> groups;
    std::vector<glm::uvec2> ranges;
    for (const ClusterGroup& group : clusters_.groups()) {
      if (group.blended && !view.labels()) continue;
      groups.push_back(&group);
      ranges.push_back(SceneClusters::cluster_triangles * glm::uvec2(group.first_cluster, group.last_cluster));
    }
    if (groups.empty()) return;
    solid_.replicate_clusters(tiles_, clusters_, groups.back()->last_cluster);
    solid_.prepare_draws(ranges);

    tools_.timer.mark("draw");
    const SurfaceState state(tools_, false);
    solid_.bind();
    for (size_t i = 0; i < groups.size(); ++i) {
      use_material(tools_, pass, view, groups[i]->material, groups[i]->mirrored);
      solid_.draw(i);
    }
  }

  void draw_blended(const View& view, const MeshPass& pass) {
    const BlendedItems blended = blended_items(tools_.scene);
    if (blended.items.empty()) return;
    blended_.replicate_items(tiles_, clusters_, blended.items);
    blended_.prepare_draws(blended.ranges);

    tools_.timer.mark("draw");
    const SurfaceState state(tools_, true);
    blended_.bind();
    for (size_t i = 0; i < blended.ranges.size(); ++i) {
      const Part& part = tools_.scene.parts()[blended.parts[i]];
      use_material(tools_, pass, view, part.material, part.mirrored);
      blended_.draw(i);
    }
  }

  DrawTools& tools_;
  ImageTiles tiles_;
  SceneClusters clusters_;
  Replicator solid_, blended_;
};

}  // namespace

std::unique_ptr<BoundDrawer> make_hybrid_drawer(DrawTools& tools) { return std::make_unique<HybridDrawer>(tools); }

}  // namespace omma
