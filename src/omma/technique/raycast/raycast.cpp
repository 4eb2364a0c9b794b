#include "omma/technique/raycast/raycast.h"

#include "omma/camera/ray_bundle.h"
#include "omma/technique/pass_cache.h"
#include "omma/technique/raycast/embree_scene.h"
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
  void scene_changed() override { trees_.update(); }
  size_t buffer_bytes() const override { return resolver_.bytes(); }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("trace");
    const RayMap& rays = rays_.get(view, make_rays);
    const std::span<const glm::vec3> at_centre;
    std::vector<RayHit> hits(rays.directions.size());
    trees_.set_view(view.worldFromCamera);
    trees_.nearest(at_centre, rays.directions, rays.size.width, view.labels() ? Solid::labels : Solid::opaque, hits);
    VisibleTriangles visible{rays.size, {}};
    visible.hits.reserve(hits.size());
    for (size_t i = 0; i < hits.size(); ++i) {
      const bool has_ray = rays.directions[i] != glm::vec3(0.0f);
      visible.hits.emplace_back(hits[i].triangle, has_ray ? hits[i].instance : VisibleTriangles::no_ray);
    }

    tools_.timer.mark("resolve");
    target.begin();
    resolver_.draw(view, visible);
    if (!view.labels() && trees_.has_blending()) {
      tools_.timer.mark("blend");
      resolver_.draw_layers(view, trees_.blended(at_centre, rays.directions, hits));
    }
  }

 private:
  DrawTools& tools_;
  EmbreeScene trees_;
  Resolver resolver_;
  PassCache<RayMap> rays_;
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
