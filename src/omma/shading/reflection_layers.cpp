#include "omma/shading/reflection_layers.h"

#include <algorithm>
#include <bit>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/scene/object.h"

namespace omma {
namespace {

constexpr const char* lens = "stereographic:fov_deg=220";
constexpr double rim = 1.0 / 1.4281480067;  ///< tan 45° over tan 55°: where its own half ends, of the map's half side

}  // namespace

ReflectionLayers plan_reflection_layers(const Scene& scene, int object, int size) {
  const Bounds bounds = object_bounds(scene, object);
  if (bounds.empty()) throw CommandError("the scene has no object {} that could reflect", object);
  ReflectionLayers layers{make_camera(lens, ImageSize{size, size}), {}, 1};
  for (int side = 0; side < 2; ++side) {
    layers.worldFromMap[side] = look_at_worldFromCamera(glm::dvec3(0.0), {0.0, 0.0, side == 0 ? -1.0 : 1.0});
    layers.worldFromMap[side][3] = glm::dvec4(bounds.center(), 1.0);
  }
  // A texel of the smallest level is at most half as wide as what a map sees beyond its half.
  const double beyond = 0.5 * size * (1.0 - rim);
  layers.levels = std::max(1, int(std::bit_width(unsigned(beyond))) - 1);
  return layers;
}

}  // namespace omma
