#include "omma/technique/visibility/visibility.h"

#include "omma/technique/pass_cache.h"
#include "omma/technique/resolve.h"
#include "omma/visibility/camera_rays.h"
#include "omma/visibility/finder.h"

namespace omma {
namespace {

RayTree make_tree(const Camera& camera, const PixelRect& tile, const glm::dvec2& shift) {
  return RayTree(CameraRays(camera, tile, {shift}));
}

class Visibility : public Technique {
 public:
  explicit Visibility(DrawTools& tools) : tools_(tools), index_(tools.index.get()), resolver_(tools) {}
  bool multisamples() const override { return false; }
  size_t shifts_at_once(ImageSize size) const override {
    return index_.has_blending() ? 1 : resolver_.samples_at_once(size);
  }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("find");
    const Finder finder(index_, view.worldFromCamera);
    const size_t pixels = size_t(view.size().width) * size_t(view.size().height);
    const bool layered = !view.labels() && index_.has_blending();
    std::vector<float> distances(layered ? pixels : 0);
    resolver_.begin();
    for (const glm::dvec2& shift : view.all_shifts()) {
      tools_.timer.mark("ray tree");
      const RayTree& rays = rays_.get(view, shift, make_tree);
      tools_.timer.mark("find");
      visible_.size = view.size();
      visible_.hits.resize(pixels);
      finder.nearest(rays, view.labels() ? Solid::labels : Solid::opaque, visible_.hits, distances);
      resolver_.add(visible_);
    }

    tools_.timer.mark("resolve");
    resolver_.draw(view, target);
    if (layered) {
      tools_.timer.mark("blend");
      resolver_.draw_layers(view, finder.blended(rays_.get(view, view.shift, make_tree), distances));
    }
  }

  size_t buffer_bytes() const override {
    size_t sum = index_.bytes() + resolver_.bytes();
    rays_.each([&](const RayTree& rays) { sum += rays.bytes(); });
    return sum;
  }

 private:
  DrawTools& tools_;
  const SceneIndex& index_;
  Resolver resolver_;
  PassCache<RayTree> rays_;
  VisibleTriangles visible_;  ///< of the sample that is being found
};

}  // namespace

const TechniqueEntry visibility_technique{
    {.name = "visibility",
     .description = "a tree of the camera's rays finds the triangle that each pixel sees; exact for every "
                    "camera",
     .exact = true,
     .needs_project = false,
     .variants = {{.name = "cpu",
                   .description = "on the processor, with SIMD and all cores, colour too",
                   .without_gl = true,
                   .with_gl = "resolve"},
                  {.name = "resolve", .description = "on the processor; OpenGL gives the triangles their colours"},
                  {.name = "gpu", .description = "compute shaders find the triangles"}}},
    [](DrawTools& tools, const std::string& variant) -> std::unique_ptr<Technique> {
      if (variant == "gpu") return make_gpu_visibility(tools);
      return std::make_unique<Visibility>(tools);
    }};

}  // namespace omma
