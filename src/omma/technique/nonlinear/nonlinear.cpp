#include "omma/technique/nonlinear/nonlinear.h"

#include <algorithm>
#include <iterator>

#include "omma/technique/nonlinear/bound_drawer.h"

namespace omma {
namespace {

struct Variant {
  VariantInfo info;
  std::unique_ptr<BoundDrawer> (*make)(DrawTools&);
};

const Variant variants[] = {
    {{"hybrid", "rasterized where the lens leaves it straight, else polygons and squares of the image around it"},
     make_hybrid_drawer},
    {{"triangle", "up to four triangles around each, their sides along its curved edges"}, make_triangle_drawer},
    {{"quad", "a box around each"}, make_quad_drawer},
};

class Nonlinear : public Technique {
 public:
  Nonlinear(DrawTools& tools, std::unique_ptr<BoundDrawer> drawer)
      : tools_(tools), exact_(tools), drawer_(std::move(drawer)) {}
  bool multisamples() const override { return true; }
  bool draws_depth() const override { return true; }
  void scene_changed(const SceneChanges& changes) override { drawer_->scene_changed(changes); }
  size_t buffer_bytes() const override { return drawer_->buffer_bytes(); }

  void draw(const View& view, const Target& target) override {
    exact_.set(view.show_overdraw && !view.labels() ? FragmentUse::overdraw : FragmentUse::surfaces);
    tools_.multisampled(view, target, [&](const Target& image) {
      image.begin();
      tools_.timer.mark("background");
      tools_.draw_background(view);
      tools_.timer.mark("draw");
      drawer_->draw(view, exact_);
    });
    if (view.bound_fragments != nullptr) count(view, *view.bound_fragments);
  }

 private:
  /// Draws twice more, one sample a pixel and nothing hidden.
  void count(const View& view, BoundFragments& fragments) {
    tools_.timer.mark("count fragments");
    View counted = view;
    counted.sample_places = one_sample_place;
    const gl::Framebuffer nothing = gl::create_framebuffer();
    glNamedFramebufferParameteri(nothing.id(), GL_FRAMEBUFFER_DEFAULT_WIDTH, view.size().width);
    glNamedFramebufferParameteri(nothing.id(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, view.size().height);
    glBindFramebuffer(GL_FRAMEBUFFER, nothing.id());
    glViewport(0, 0, view.size().width, view.size().height);
    gl::Counters of_picture;
    std::swap(of_picture, tools_.counters);
    const auto samples_of = [&](FragmentUse use) {
      exact_.set(use);
      glBindFramebuffer(GL_FRAMEBUFFER, nothing.id());
      drawer_->draw(counted, exact_);
      return tools_.counters.finish().samples;
    };
    fragments.touched += samples_of(FragmentUse::touched);
    fragments.kept += samples_of(FragmentUse::kept);
    std::swap(of_picture, tools_.counters);
  }

  DrawTools& tools_;
  ExactStage exact_;
  std::unique_ptr<BoundDrawer> drawer_;
};

std::vector<VariantInfo> variant_infos() {
  std::vector<VariantInfo> infos;
  for (const Variant& variant : variants) infos.push_back(variant.info);
  return infos;
}

}  // namespace

const TechniqueEntry nonlinear_technique{
    {.name = "nonlinear",
     .description = "each triangle once, its curved edges decided by every fragment's ray; exact for every camera",
     .exact = true,
     .needs_project = false,
     .bounds = true,
     .variants = variant_infos()},
    [](DrawTools& tools, const std::string& name) -> std::unique_ptr<Technique> {
      const Variant& variant = *std::find_if(std::begin(variants), std::end(variants),
                                             [&](const Variant& entry) { return entry.info.name == name; });
      return std::make_unique<Nonlinear>(tools, variant.make(tools));
    }};

}  // namespace omma
