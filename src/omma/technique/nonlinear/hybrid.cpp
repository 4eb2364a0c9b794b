#include "omma/technique/nonlinear/bound_drawer.h"
#include "omma/technique/nonlinear/image_tiles.h"
#include "omma/technique/replication/blended_items.h"
#include "omma/technique/replication/replicator.h"
#include "omma/technique/replication/scene_clusters.h"

namespace omma {
namespace {

/// Polygons are cut by three planes, for as long as it lives.
class ClipPlanes {
 public:
  ClipPlanes() {
    for (int i = 0; i < 3; ++i) glEnable(GLenum(GL_CLIP_DISTANCE0 + i));
  }
  ~ClipPlanes() {
    for (int i = 0; i < 3; ++i) glDisable(GLenum(GL_CLIP_DISTANCE0 + i));
  }
  ClipPlanes(const ClipPlanes&) = delete;
  ClipPlanes& operator=(const ClipPlanes&) = delete;
};

class HybridDrawer : public BoundDrawer {
 public:
  explicit HybridDrawer(DrawTools& tools)
      : tools_(tools),
        clusters_(tools.scene),
        straight_(tools),
        solid_(tools, ReplicaShape::hexagon),
        blended_(tools, ReplicaShape::hexagon) {}

  void scene_changed(const SceneChanges& changes) override { clusters_.update(changes); }
  size_t buffer_bytes() const override {
    return tiles_.bytes() + clusters_.bytes() + straight_.bytes() + solid_.bytes() + blended_.bytes();
  }

  void draw(const View& view, const ExactStage& exact) override {
    tools_.timer.mark("tiles");
    tiles_.set(view);
    draw_solid(view, exact);
    if (!view.labels() && tools_.scene.has_blending()) draw_blended(view, exact);
  }

 private:
  /// The pass with what the vertex stages ask of the camera.
  MeshPass outlined(MeshPass pass) const {
    pass.defines.merge(tiles_.outline_defines());
    pass.set_uniforms = [this, set = pass.set_uniforms](const gl::Program& program) {
      set(program);
      tiles_.set_uniforms(program);
    };
    return pass;
  }

  MeshPass exact_pass(const View& view, const ExactStage& exact) const {
    return outlined(exact.pass(view, {{GL_VERTEX_SHADER, "technique/nonlinear/bound.vert"}}));
  }

  void draw_solid(const View& view, const ExactStage& exact) {
    const DrawnGroups drawn = clusters_.unordered(view.labels());
    if (drawn.groups.empty()) return;
    const auto draw = [&](Forms forms, Replicator& replicator, const MeshPass& pass) {
      tiles_.look_for(forms);
      replicator.replicate_clusters(tiles_, clusters_, drawn.clusters);
      if (replicator.replica_count() == 0) return;
      replicator.prepare_draws(drawn.ranges);
      tools_.timer.mark("draw");
      const SurfaceState state(tools_, false);
      replicator.bind();
      for (size_t i = 0; i < drawn.groups.size(); ++i) {
        use_material(tools_, pass, view, drawn.groups[i].material, drawn.groups[i].mirrored);
        replicator.draw(i);
      }
    };
    MeshPass pass = exact_pass(view, exact);
    if (view.camera.lens() == nullptr) {
      const ClipPlanes clip;
      return draw(Forms::all_exact, solid_, pass);
    }
    pass.defines["SOME_ARE_STRAIGHT"] = "1";
    MeshPass straight = outlined(exact.straight_pass(view, {{GL_VERTEX_SHADER, "technique/nonlinear/straight.vert"}}));
    straight.defines["PULLED"] = "1";
    draw(Forms::straight, straight_, straight);
    const ClipPlanes clip;
    draw(Forms::all_but_straight, solid_, pass);
  }

  void draw_blended(const View& view, const ExactStage& exact) {
    const BlendedItems blended = blended_items(tools_.scene);
    if (blended.items.empty()) return;
    // Exactly, so that nothing is laid twice over what is behind it.
    tiles_.look_for(Forms::all_exact);
    blended_.replicate_items(tiles_, clusters_, blended.items);
    blended_.prepare_draws(blended.ranges);

    tools_.timer.mark("draw");
    const SurfaceState state(tools_, true);
    const ClipPlanes clip;
    blended_.bind();
    const MeshPass pass = exact_pass(view, exact);
    for (size_t i = 0; i < blended.ranges.size(); ++i) {
      const Part& part = tools_.scene.parts()[blended.parts[i]];
      use_material(tools_, pass, view, part.material, part.mirrored);
      blended_.draw(i);
    }
  }

  DrawTools& tools_;
  ImageTiles tiles_;
  SceneClusters clusters_;
  Replicator straight_, solid_, blended_;
};

}  // namespace

std::unique_ptr<BoundDrawer> make_hybrid_drawer(DrawTools& tools) { return std::make_unique<HybridDrawer>(tools); }

}  // namespace omma
