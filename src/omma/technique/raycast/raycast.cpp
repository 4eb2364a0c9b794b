#include "omma/technique/raycast/raycast.h"

#include "omma/camera/ray_bundle.h"
#include "omma/oracle/embree_scene.h"
#include "omma/technique/pass_cache.h"
#include "omma/technique/resolve.h"

namespace omma {
namespace {

RayMap make_rays(const Camera& camera, const PixelRect& tile, const glm::dvec2& shift) {
  return rays_of(camera, tile, shift);
}

class Raycast : public Technique {
 public:
  explicit Raycast(DrawTools& tools) : tools_(tools), trees_(tools.scene.scene()), resolver_(tools) {}
  bool multisamples() const override { return false; }
  size_t shifts_at_once(ImageSize size) const override {
    return trees_.has_blending() ? 1 : resolver_.samples_at_once(size);
  }
  void scene_changed(const SceneChanges& changes) override { trees_.update(changes); }
  size_t buffer_bytes() const override { return resolver_.bytes(); }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("trace");
    trees_.set_view(view.worldFromCamera);
    const std::span<const glm::vec3> at_centre;
    std::vector<RayHit> hits(size_t(view.size().width) * size_t(view.size().height));
    resolver_.begin();
    for (const glm::dvec2& shift : view.all_shifts()) {
      const RayMap& rays = rays_.get(view, shift, make_rays);
      trees_.nearest(at_centre, rays.directions, rays.size.width, view.labels() ? Solid::labels : Solid::opaque, hits);
      visible_.size = rays.size;
      visible_.hits.resize(hits.size());
      for (size_t i = 0; i < hits.size(); ++i) {
        const bool has_ray = rays.directions[i] != glm::vec3(0.0f);
        visible_.hits[i] = {hits[i].triangle, has_ray ? hits[i].instance : VisibleTriangles::no_ray};
      }
      resolver_.add(visible_);
    }

    tools_.timer.mark("resolve");
    resolver_.draw(view, target);
    if (!view.labels() && trees_.has_blending()) {
      tools_.timer.mark("blend");
      const RayMap& rays = rays_.get(view, view.shift, make_rays);
      resolver_.draw_layers(view, trees_.blended(at_centre, rays.directions, hits));
    }
  }

 private:
  DrawTools& tools_;
  EmbreeScene trees_;
  Resolver resolver_;
  PassCache<RayMap> rays_;
  VisibleTriangles visible_;
};

}  // namespace

const TechniqueEntry raycast_technique{
    {.name = "raycast",
     .description = "Embree finds each pixel's triangle, a resolve pass shades it; exact for every camera",
     .exact = true,
     .needs_project = false,
     .variants = {}},
    [](DrawTools& tools, const std::string&) -> std::unique_ptr<Technique> {
      return std::make_unique<Raycast>(tools);
    }};

}  // namespace omma
