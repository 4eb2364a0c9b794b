#include "bench/direct_drawing.h"

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
    : scene_(scene, context_), tools_{context_, scene_}, shadows_(tools_, scene_) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // as Renderer sets it
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
  std::vector<Technique*> techniques;
  std::vector<const Target*> targets;
  for (const Pass& pass : passes) {
    techniques.push_back(&technique(pass));
    targets.push_back(&target(pass.camera.size(), work.output));
  }
  shadows_.use(shadowed ? Shadows::paraboloid : Shadows::off, 1024);
  tools_.timer.finish();
  tools_.counters.finish();
  const auto begin = std::chrono::steady_clock::now();
  if (!work.rasterizes) glEnable(GL_RASTERIZER_DISCARD);
  for (size_t i = 0; i < passes.size(); ++i) {
    const Pass& pass = passes[i];
    scene_.set_view(pass.worldFromCamera, glm::vec3(0.0f));
    techniques[i]->draw(view_of(pass, work.output), *targets[i]);
  }
  glFinish();
  const auto end = std::chrono::steady_clock::now();
  glDisable(GL_RASTERIZER_DISCARD);
  tools_.timer.finish();
  tools_.counters.finish();
  return std::chrono::duration<double, std::milli>(end - begin).count();
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
