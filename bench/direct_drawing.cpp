#include "bench/direct_drawing.h"

#include <algorithm>
#include <chrono>

#include "omma/technique/registry.h"

namespace omma::bench {
namespace {

std::span<const Channel> outputs_of(Output output) {
  static constexpr Channel color[] = {Channel::color}, label[] = {Channel::object};
  if (output == Output::color) return color;
  if (output == Output::coverage) return label;
  return {};
}

View view_of(const Pass& pass, Output output) {
  View view{.camera = pass.camera,
            .worldFromCamera = pass.worldFromCamera,
            .tile = {0, 0, pass.camera.size().width, pass.camera.size().height}};
  view.outputs = outputs_of(output);
  view.filter = Filter::trilinear;
  return view;
}

}  // namespace

DirectDrawing::DirectDrawing(const Scene& scene)
    : scene_(scene, context_), index_(scene), tools_{context_, scene_, index_, programs_}, shadows_(tools_, scene_) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // as Device sets it
  glEnable(GL_DEPTH_CLAMP);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

Technique& DirectDrawing::technique(const Pass& pass) {
  std::unique_ptr<Technique>& technique = techniques_[pass.technique];
  const ChosenTechnique chosen = choose_technique(pass.technique, pass.camera);
  if (!technique) technique = chosen.entry->make(tools_, chosen.variant);
  return *technique;
}

const Target& DirectDrawing::target(ImageSize size, Output output) {
  Target& target = targets_[{size.width, size.height, output}];
  if (target.framebuffer() == 0) target = Target(size, outputs_of(output));
  return target;
}

double DirectDrawing::draw(std::span<const Pass> passes, const Work& work, bool shadowed) {
  context_.make_current();
  shadows_.use(shadowed ? Shadows::paraboloid : Shadows::off, 1024);
  const auto is_same = [](const Pass& a, const Pass& b) { return a.technique == b.technique && a.camera == b.camera; };
  if (!std::equal(passes.begin(), passes.end(), last_passes_.begin(), last_passes_.end(), is_same)) {
    draw_passes(passes, work);
    last_passes_.assign(passes.begin(), passes.end());
  }
  const auto begin = std::chrono::steady_clock::now();
  draw_passes(passes, work);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void DirectDrawing::draw_passes(std::span<const Pass> passes, const Work& work) {
  if (!work.rasterizes) glEnable(GL_RASTERIZER_DISCARD);
  for (const Pass& pass : passes) {
    scene_.set_view(pass.worldFromCamera, glm::vec3(0.0f));
    technique(pass).draw(view_of(pass, work.output), target(pass.camera.size(), work.output));
  }
  glFinish();
  glDisable(GL_RASTERIZER_DISCARD);
  tools_.timer.finish();
  tools_.counters.finish();
}

BoundFragments DirectDrawing::bound_fragments(std::span<const Pass> passes) {
  context_.make_current();
  BoundFragments fragments;
  for (const Pass& pass : passes) {
    scene_.set_view(pass.worldFromCamera, glm::vec3(0.0f));
    View view = view_of(pass, Output::color);
    view.bound_fragments = &fragments;
    technique(pass).draw(view, target(pass.camera.size(), Output::color));
  }
  return fragments;
}

}  // namespace omma::bench
