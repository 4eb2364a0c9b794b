// Hugin's architectural projection: Miller's cylinder above the horizon, which spares tall buildings, and Lambert's
// equal-area cylinder below it, which shrinks the ground. Both have the same scale at the horizon.
#ifdef __cplusplus
inline constexpr LensInfo architectural_info = {
    .name = "architectural",
    .group = "panoramic",
    .also = "arch, architectural_panorama",
    .formula = "x = longitude, y = 5/4 ln tan(45° + 2/5 latitude) above the horizon, sin(latitude) below",
    .source = "Hugin Architectural (13), libpano13",
    .example = "architectural:fov_deg=240",
    .default_fov_deg = 180,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

#ifndef __cplusplus
#include "models/miller.h"
#endif

LENS_FUNCTION bool architectural_project(Params params, vec3 direction, OUT(vec2) plane) {
  real height = direction.y < real(0.0) ? miller_height(latitude_of(direction)) : direction.y / length(direction);
  plane = vec2(longitude_of(direction), height);
  return within_angle(params, direction);
}

LENS_FUNCTION bool architectural_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real sine = min(plane.y, real(1.0));
  real below = atan(sine, sqrt((real(1.0) - sine) * (real(1.0) + max(sine, real(-1.0)))));
  real latitude = plane.y < real(0.0) ? miller_latitude(plane.y) : below;
  direction = direction_at(plane.x, latitude);
  return abs(plane.x) <= lens_pi && latitude >= real(-0.5) * lens_pi && plane.y <= real(1.0) &&
         within_angle(params, direction);
}
