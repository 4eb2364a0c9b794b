#include "omma/technique/vertex/vertex.h"

#include <fmt/core.h>

#include "omma/technique/mesh_pass.h"

namespace omma {
namespace {

class Vertex : public Technique {
 public:
  explicit Vertex(DrawTools& tools) : tools_(tools) {}
  bool multisamples() const override { return true; }
  bool draws_depth() const override { return true; }

  void draw(const View& view, const Target& target) override {
    gl::Defines defines = camera_defines(view.camera);
    defines["NEAR"] = fmt::format("{:.9f}", near_depth);
    tools_.multisampled(view, target, [&](const Target& image) {
      image.begin();
      tools_.timer.mark("background");
      tools_.draw_background(view);
      tools_.timer.mark("draw");
      MeshDrawer(tools_).draw(
          {.stages = {{GL_VERTEX_SHADER, "technique/straight.vert"}, {GL_GEOMETRY_SHADER, "technique/straight.geom"}},
           .defines = defines,
           .set_uniforms =
               [&](const gl::Program& program) {
                 set_camera(program, view);
                 program.set("tile_size", glm::vec2(view.size().width, view.size().height));
                 program.set("image_size", glm::vec2(view.camera.size().width, view.camera.size().height));
               },
           .may_be_seen = [](const Bounds&) { return true; }},
          view);
    });
  }

 private:
  DrawTools& tools_;
};

}  // namespace

const TechniqueEntry vertex_technique{
    {.name = "vertex",
     .description = "vertices projected, edges straight; wrong where a triangle is large in the image",
     .exact = false,
     .needs_project = true,
     .variants = {}},
    [](DrawTools& tools, const std::string&) -> std::unique_ptr<Technique> { return std::make_unique<Vertex>(tools); }};

}  // namespace omma
