#include "omma/technique/pass_cache.h"
#include "omma/technique/resolve.h"
#include "omma/technique/visibility/gpu_finder.h"
#include "omma/technique/visibility/visibility.h"
#include "omma/visibility/camera_rays.h"

namespace omma {
namespace {

class GpuVisibility : public Technique {
 public:
  explicit GpuVisibility(DrawTools& tools) : tools_(tools), finder_(tools), resolver_(tools) {}
  bool multisamples() const override { return false; }
  size_t shifts_at_once(ImageSize size) const override {
    return finder_.has_blending() ? 1 : resolver_.samples_at_once(size);
  }
  void scene_changed(const SceneChanges&) override {
    tools_.timer.mark("refit");
    finder_.update();
  }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("place");
    finder_.set_view(view.worldFromCamera);
    std::vector<std::vector<RayHit>> layers;
    resolver_.begin();
    for (const glm::dvec2& shift : view.all_shifts()) {
      tools_.timer.mark("ray tree");
      const GpuRays& rays = rays_.get(view, shift, [this](const Camera& camera, const PixelRect& tile, glm::dvec2 at) {
        return GpuRays(RayTree(CameraRays(camera, tile, {at})), tools_.context.limits());
      });
      tools_.timer.mark("find");
      VisibleTriangles visible = finder_.nearest(rays, view.labels() ? Solid::labels : Solid::opaque);
      resolver_.add(visible);
      if (!view.labels() && finder_.has_blending()) layers = finder_.blended(rays);
    }

    tools_.timer.mark("resolve");
    resolver_.draw(view, target);
    if (!layers.empty()) {
      tools_.timer.mark("blend");
      resolver_.draw_layers(view, layers);
    }
  }

  size_t buffer_bytes() const override {
    size_t sum = finder_.bytes() + resolver_.bytes();
    rays_.each([&](const GpuRays& rays) { sum += rays.bytes(); });
    return sum;
  }

 private:
  DrawTools& tools_;
  GpuFinder finder_;
  Resolver resolver_;
  PassCache<GpuRays> rays_;
};

}  // namespace

std::unique_ptr<Technique> make_gpu_visibility(DrawTools& tools) { return std::make_unique<GpuVisibility>(tools); }

}  // namespace omma
