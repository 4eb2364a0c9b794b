#include <optional>

#include "omma/camera/bounds/lens_bound.h"
#include "omma/technique/nonlinear/bound_drawer.h"

namespace omma {
namespace {

/// Pixels. Rounding of the GPU's formulae (docs: project is within 3e-3 px of double precision) and of the rasterizer's
/// 1/256 px, and some more.
constexpr double margin_px = 0.0625;

/// Draws a triangle as the paper's shape around its image where the lens has radial symmetry; through squares of the
/// image where it has not, or where the camera is rays.
class EnclosingDrawer : public BoundDrawer {
 public:
  EnclosingDrawer(DrawTools& tools, BoundingShape shape) : tools_(tools), shape_(shape) {}

  void scene_changed(const SceneChanges& changes) override {
    if (tiles_) tiles_->scene_changed(changes);
  }
  size_t buffer_bytes() const override { return tiles_ ? tiles_->buffer_bytes() : 0; }

  void draw(const View& view, const ExactStage& exact) override {
    set_camera_bound(view.camera);
    if (!bound_) {
      if (!tiles_) tiles_ = make_hybrid_drawer(tools_);
      return tiles_->draw(view, exact);
    }
    MeshDrawer drawer(tools_);
    drawer.draw_solid(pass(view, exact, shape_), view);
    // What is blended may not be drawn twice where triangles of a shape overlap.
    if (!view.labels() && tools_.scene.has_blending())
      drawer.draw_blended(pass(view, exact, BoundingShape::quad), view);
  }

 private:
  void set_camera_bound(const Camera& camera) {
    if (camera_ == camera) return;
    camera_ = camera;
    bound_ = camera.lens() != nullptr ? lens_bound(*camera.lens(), margin_px) : std::nullopt;
  }

  MeshPass pass(const View& view, const ExactStage& exact, BoundingShape shape) const {
    MeshPass pass = exact.pass(view, {{GL_VERTEX_SHADER, "technique/nonlinear/corner.vert"},
                                      {GL_GEOMETRY_SHADER, "technique/nonlinear/enclose.geom"}});
    if (shape == BoundingShape::quad) pass.defines["SHAPE_QUAD"] = "";
    pass.set_uniforms = [set = pass.set_uniforms, this](const gl::Program& program) {
      set(program);
      set_lens_bound(program, *bound_);
    };
    return pass;
  }

  DrawTools& tools_;
  BoundingShape shape_;
  std::optional<Camera> camera_;  ///< kept alive: another one may not come to lie at its address
  std::optional<LensBound> bound_;
  std::unique_ptr<BoundDrawer> tiles_;
};

}  // namespace

std::unique_ptr<BoundDrawer> make_triangle_drawer(DrawTools& tools) {
  return std::make_unique<EnclosingDrawer>(tools, BoundingShape::triangles);
}

std::unique_ptr<BoundDrawer> make_quad_drawer(DrawTools& tools) {
  return std::make_unique<EnclosingDrawer>(tools, BoundingShape::quad);
}

}  // namespace omma
