// Equal-area octahedral map: the square of the octahedral map, with equal solid angles in equal areas. What pbrt keeps
// its environment maps in.
#ifdef __cplusplus
inline constexpr LensInfo octahedral_equal_area_info = {
    .name = "octahedral_equal_area",
    .group = "layout",
    .also = "equal_area_octahedral, clarberg",
    .formula = "r = abs x + abs y = √(1 - abs dz), abs y / r = 2/π atan abs(dy / dx), folded behind",
    .source = "Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD; pbrt-v4 EqualAreaSquareToSphere",
    .example = "octahedral_equal_area:width=480,height=480",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-1.0, -1.0}, {1.0, 1.0}};
    },
    .parts = [](const LensParameters&) -> std::vector<PlanePolygon> {
      return {{{0.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}},  {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}},
              {{0.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}},  {{0.0, 0.0}, {-1.0, 0.0}, {0.0, -1.0}},
              {{1.0, -1.0}, {1.0, 0.0}, {0.0, -1.0}}, {{1.0, 1.0}, {0.0, 1.0}, {1.0, 0.0}},
              {{-1.0, 1.0}, {-1.0, 0.0}, {0.0, 1.0}}, {{-1.0, -1.0}, {0.0, -1.0}, {-1.0, 0.0}}};
    },
};
#endif

#ifndef __cplusplus
#include "models/octahedral.h"
#endif

LENS_FUNCTION bool octahedral_equal_area_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec3 unit = direction / length(direction);
  vec2 across = abs(vec2(unit.x, unit.y));
  real rho = length(across);
  real r = rho / sqrt(real(1.0) + abs(unit.z));
  real y = rho > real(0.0) ? r * atan(across.y, across.x) * (real(2.0) / lens_pi) : real(0.0);
  plane = vec2(unit.x < real(0.0) ? y - r : r - y, unit.y < real(0.0) ? -y : y);
  if (unit.z < real(0.0)) plane = octahedral_fold(plane);
  return within_angle(params, direction);
}

LENS_FUNCTION bool octahedral_equal_area_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real ahead = real(1.0) - abs(plane.x) - abs(plane.y);
  vec2 diamond = ahead < real(0.0) ? octahedral_fold(plane) : plane;
  real r = real(1.0) - abs(ahead);
  real turn = r > real(0.0) ? abs(diamond.y) / r * (real(0.5) * lens_pi) : real(0.0);
  real rho = r * sqrt(real(2.0) - r * r);
  real z = (real(1.0) - r) * (real(1.0) + r);
  direction = vec3(rho * (diamond.x < real(0.0) ? -cos(turn) : cos(turn)),
                   rho * (diamond.y < real(0.0) ? -sin(turn) : sin(turn)), ahead < real(0.0) ? -z : z);
  return abs(plane.x) <= real(1.0) && abs(plane.y) <= real(1.0) && within_angle(params, direction);
}
