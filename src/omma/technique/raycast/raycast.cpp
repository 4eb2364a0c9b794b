#include "omma/technique/raycast/raycast.h"

#include <algorithm>
#include <map>
#include <optional>

#include "omma/camera/ray_bundle.h"
#include "omma/technique/raycast/embree_scene.h"
#include "omma/technique/resolve.h"

namespace omma {
namespace {

class Raycast : public Technique {
 public:
  explicit Raycast(DrawTools& tools) : tools_(tools), trees_(tools.scene.scene()), resolver_(tools) {}
  bool multisamples() const override { return false; }
  void scene_changed() override { trees_.update(); }
  size_t buffer_bytes() const override { return resolver_.bytes(); }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("trace");
    const RayMap& rays = rays_for(view);
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
      draw_blended(view, trees_.blended(at_centre, rays.directions, hits));
    }
  }

 private:
  /// Rays take longer to compute than to trace, and a sequence asks for the same ones again and again.
  const RayMap& rays_for(const View& view) {
    constexpr size_t kept = 16;
    if (rays_camera_ != view.camera || rays_tile_ != view.tile || rays_.size() >= kept) {
      rays_.clear();
      rays_camera_ = view.camera;
      rays_tile_ = view.tile;
    }
    const std::pair shift(view.shift.x, view.shift.y);
    const auto found = rays_.find(shift);
    if (found != rays_.end()) return found->second;
    return rays_.emplace(shift, rays_of(view.camera, view.tile, view.shift)).first->second;
  }

  /// Layer by layer from the farthest. A pixel with fewer surfaces than its neighbour joins in at the nearer layers.
  void draw_blended(const View& view, const std::vector<std::vector<RayHit>>& surfaces) {
    size_t layers = 0;
    for (const auto& along_ray : surfaces) layers = std::max(layers, along_ray.size());
    VisibleTriangles visible{view.size(), std::vector<glm::uvec2>(surfaces.size())};
    for (size_t layer = layers; layer-- > 0;) {
      for (size_t i = 0; i < surfaces.size(); ++i) {
        visible.hits[i] = layer < surfaces[i].size()
                              ? glm::uvec2(surfaces[i][layer].triangle, surfaces[i][layer].instance)
                              : glm::uvec2(VisibleTriangles::nothing);
      }
      resolver_.draw_over(view, visible);
    }
  }

  DrawTools& tools_;
  EmbreeScene trees_;
  Resolver resolver_;
  std::optional<Camera> rays_camera_;
  PixelRect rays_tile_;
  std::map<std::pair<double, double>, RayMap> rays_;  ///< by the pass's shift
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
