#include "omma/technique/nonlinear/exact_stage.h"

#include <fmt/format.h>

#include "omma/technique/sample_places.h"

namespace omma {

void ExactStage::set(const View& view) {
  if (samples_ == view.samples) return;
  samples_ = view.samples;
  sample_places_ = sample_places(samples_);
}

MeshPass ExactStage::straight_pass(const View& view, std::vector<gl::Stage> stages) const {
  MeshPass straight = pass(view, std::move(stages));
  straight.fragment_shader = MeshPass{}.fragment_shader;
  return straight;
}

MeshPass ExactStage::pass(const View& view, std::vector<gl::Stage> stages) const {
  gl::Defines defines = camera_defines(view.camera);
  defines["SAMPLES"] = std::to_string(sample_places_.size());
  defines["NEAR"] = fmt::format("{:.9f}", near_depth);
  return {.stages = std::move(stages),
          .defines = std::move(defines),
          .set_uniforms =
              [this, &view](const gl::Program& program) {
                set_camera(program, view);
                program.set("tile_size", glm::vec2(view.size().width, view.size().height));
                program.set("sample_places", std::span<const glm::ivec2>(sample_places_));
                tools_.camera_textures.bind(view.camera);
                tools_.scene.bind_vertex_textures();
              },
          .may_be_seen = [](const Bounds&) { return true; },
          .culls = false,
          .fragment_shader = "technique/nonlinear/exact.frag"};
}

}  // namespace omma
