#include "omma/base/error.h"
#include "omma/technique/piecewise/blended_replicas.h"
#include "omma/technique/piecewise/piece_drawer.h"

namespace omma {
namespace {

constexpr int max_runs = 24;       ///< of a patch: two numbers each, of the 120 that drivers take at least
constexpr int pieces_a_point = 8;  ///< three vertices each, of the 1024 components that a geometry shader may write
/// Lines of 65 points, 64 of them, are what every driver's tessellation unit can make of a patch.
constexpr size_t max_pieces = 64 * 65 * pieces_a_point;

class TessellatorDrawer : public PieceDrawer {
 public:
  explicit TessellatorDrawer(DrawTools& tools) : tools_(tools), clusters_(tools.scene), blended_(tools) {}

  void scene_changed(const SceneChanges& changes) override { clusters_.update(changes); }
  size_t buffer_bytes() const override { return clusters_.bytes() + blended_.bytes(); }

  void draw(const View& view, const GpuPieces& pieces) override {
    if (pieces.count() > max_pieces) {
      throw MachineError(
          "{} pieces are more than the tessellation unit can make replicas for, {}; use piecewise:compute or smaller "
          "tiles",
          pieces.count(), max_pieces);
    }
    draw_solid(view, pieces);
    if (!view.labels() && tools_.scene.has_blending()) blended_.draw(view, pieces, clusters_);
  }

 private:
  void draw_solid(const View& view, const GpuPieces& pieces) {
    clusters_.narrow(tools_, pieces);
    tools_.timer.mark("draw");
    const PieceClipping clipping;
    const SurfaceState state(tools_, false);
    glBindVertexArray(tools_.no_vertices.id());
    pieces.bind();
    clusters_.bind();
    MeshPass pass = replica_pass(pieces, {{GL_VERTEX_SHADER, "technique/piecewise/tessellate.vert"},
                                          {GL_TESS_CONTROL_SHADER, "technique/piecewise/tessellate.tesc"},
                                          {GL_TESS_EVALUATION_SHADER, "technique/piecewise/tessellate.tese"},
                                          {GL_GEOMETRY_SHADER, "technique/piecewise/expand.geom"}});
    pass.defines["MAX_RUNS"] = std::to_string(max_runs);
    pass.defines["PIECES_A_POINT"] = std::to_string(pieces_a_point);
    glPatchParameteri(GL_PATCH_VERTICES, 1);
    for (const ClusterGroup& group : clusters_.groups()) {
      if (group.blended && !view.labels()) continue;
      const gl::Program& program = use_material(tools_, pass, view, group.material, group.mirrored);
      program.set("cluster_count", unsigned(clusters_.cluster_count()));
      glDrawArrays(GL_PATCHES, GLint(SceneClusters::cluster_triangles * group.first_cluster),
                   GLsizei(SceneClusters::cluster_triangles * (group.last_cluster - group.first_cluster)));
    }
  }

  DrawTools& tools_;
  SceneClusters clusters_;
  BlendedReplicas blended_;
};

}  // namespace

std::unique_ptr<PieceDrawer> make_tessellator_drawer(DrawTools& tools) {
  return std::make_unique<TessellatorDrawer>(tools);
}

}  // namespace omma
