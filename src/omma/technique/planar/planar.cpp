#include "omma/technique/planar/planar.h"

#include <glm/gtc/matrix_transform.hpp>
#include <string_view>

#include "omma/technique/mesh_pass.h"

namespace omma {
namespace {

class Planar : public Technique {
 public:
  explicit Planar(DrawTools& tools) : tools_(tools) {}
  bool multisamples() const override { return true; }
  bool draws_depth() const override { return true; }

  void draw(const View& view, const Target& target) override {
    const Lens& lens = *view.camera.lens();
    const glm::dvec2 first = (glm::dvec2(view.pixel_offset()) - lens.centre) / lens.focal;
    const glm::dvec2 last = first + glm::dvec2(view.size().width, view.size().height) / lens.focal;
    const glm::dmat4 flatFromLens = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, -1.0));
    const glm::dmat4 flatFromCamera = flatFromLens * glm::dmat4(glm::transpose(lens.cameraFromLens));
    const glm::dmat4 clipFromCamera = clip_from_flat_frame({first.x, last.x}, {first.y, last.y}) * flatFromCamera;
    const glm::dmat4 clipFromWorld = clipFromCamera * glm::inverse(view.worldFromCamera);

    tools_.multisampled(view, target, [&](const Target& image) {
      image.begin();
      tools_.timer.mark("background");
      tools_.draw_background(view);
      tools_.timer.mark("draw");
      MeshDrawer(tools_).draw(
          {.stages = {{GL_VERTEX_SHADER, "technique/mesh.vert"}},
           .defines = {},
           .set_uniforms =
               [&](const gl::Program& program) { program.set("clipFromCamera", glm::mat4(clipFromCamera)); },
           .may_be_seen = [&](const Bounds& world) { return may_be_in_frustum(clipFromWorld, world); }},
          view);
    });
  }

 private:
  DrawTools& tools_;
};

}  // namespace

bool planar_draws(const Camera& camera) {
  return camera.lens() != nullptr && std::string_view(camera.lens()->model->info.name) == "perspective";
}

glm::dmat4 clip_from_flat_frame(glm::dvec2 x, glm::dvec2 y) {
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / (x[1] - x[0]);
  clip[1][1] = 2.0 / (y[1] - y[0]);
  clip[2] = glm::dvec4(-(x[0] + x[1]) / (x[1] - x[0]), -(y[0] + y[1]) / (y[1] - y[0]), 0.0, 1.0);
  clip[3][2] = near_depth;
  return clip;
}

const TechniqueEntry planar_technique{
    {.name = "planar",
     .description = "the perspective camera with one matrix, as GPUs draw it; for that camera only",
     .exact = true,
     .needs_project = true,
     .variants = {}},
    [](DrawTools& tools, const std::string&) -> std::unique_ptr<Technique> { return std::make_unique<Planar>(tools); }};

}  // namespace omma
