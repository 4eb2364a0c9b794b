#include "omma/technique/nonlinear/exact_stage.h"

#include <fmt/core.h>

namespace omma {
namespace {

constexpr const char* fragment_shaders[] = {"technique/nonlinear/exact.frag", "technique/nonlinear/overdraw.frag",
                                            "technique/nonlinear/touched.frag", "technique/nonlinear/kept.frag"};

}  // namespace

MeshPass ExactStage::straight_pass(const View& view, std::vector<gl::Stage> stages) const {
  MeshPass straight = pass(view, std::move(stages));
  straight.fragment_shader = use_ == FragmentUse::surfaces   ? "technique/mesh.frag"
                             : use_ == FragmentUse::overdraw ? "technique/nonlinear/overdraw_straight.frag"
                                                             : "technique/nonlinear/touched.frag";
  return straight;
}

MeshPass ExactStage::pass(const View& view, std::vector<gl::Stage> stages) const {
  gl::Defines defines = camera_defines(view.camera);
  defines["SAMPLES"] = std::to_string(view.samples());
  defines["NEAR"] = fmt::format("{:.9f}", near_depth);
  return {.stages = std::move(stages),
          .defines = std::move(defines),
          .set_uniforms =
              [this, &view](const gl::Program& program) {
                set_camera(program, view);
                program.set("tile_size", glm::vec2(view.size().width, view.size().height));
                program.set("sample_places", view.sample_places);
                tools_.camera_textures.bind(view.camera);
                tools_.scene.bind_vertex_textures();
              },
          .may_be_seen = [](const Bounds&) { return true; },
          .culls = false,
          .fragment_shader = fragment_shaders[size_t(use_)]};
}

}  // namespace omma
