#include "omma/viewpoint/viewpoint.h"

#include <algorithm>
#include <cmath>

#include "omma/viewpoint/framing.h"
#include "omma/viewpoint/standing_place.h"

namespace omma {
namespace {

/// Numbers that are short to type: to a thousandth of the scene's size, or what is left of it far from the origin.
glm::dvec3 rounded(const glm::dvec3& point, double size) {
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 3.0);
  // Dividing by a whole number is exact where multiplying by 0.001 leaves digits behind.
  return unit < 1.0 ? glm::round(point * std::round(1.0 / unit)) / std::round(1.0 / unit)
                    : glm::round(point / unit) * unit;
}

}  // namespace

Viewpoint default_viewpoint(const Scene& scene, const Camera& camera) {
  if (!scene.default_is_guess) return {scene.default_from, scene.default_to};
  const std::optional<Viewpoint> place = find_standing_place(scene);
  const Viewpoint viewpoint = place ? *place : frame_object(scene, camera);
  const double size = glm::length(scene.bounds().extent());
  if (!(size > 0.0)) return viewpoint;
  const Viewpoint short_text{rounded(viewpoint.from, size), rounded(viewpoint.to, size)};
  return short_text.from == short_text.to ? viewpoint : short_text;
}

}  // namespace omma
