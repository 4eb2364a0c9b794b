#include "omma/camera/ray_bundle.h"

#include <tbb/parallel_for.h>

namespace omma {
namespace {

template <typename Form>
RayMap sample(const Form& form, const PixelRect& region, const glm::dvec2& shift) {
  RayMap map{.size = {region.width(), region.height()}, .directions = {}, .source = {}};
  if (region.empty()) return map;
  map.directions.resize(static_cast<size_t>(region.width()) * region.height());
  tbb::parallel_for(region.y0, region.y1, [&](int y) {
    glm::vec3* row = map.directions.data() + static_cast<size_t>(y - region.y0) * region.width();
    for (int x = region.x0; x < region.x1; ++x, ++row) {
      *row = glm::vec3(form.unproject(glm::dvec2(x + 0.5, y + 0.5) + shift).value_or(glm::dvec3(0.0)));
    }
  });
  return map;
}

}  // namespace

RayMap rays_of(const Camera& camera, const PixelRect& region, const glm::dvec2& shift) {
  if (camera.lens()) return sample(*camera.lens(), region, shift);
  return camera.pieces() ? sample(*camera.pieces(), region, shift) : sample(*camera.ray_map(), region, shift);
}

RayMap rays_of(const Camera& camera) { return rays_of(camera, {0, 0, camera.size().width, camera.size().height}); }

}  // namespace omma
