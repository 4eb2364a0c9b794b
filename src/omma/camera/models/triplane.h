// Three planes side by side, the middle one ahead: a triptych of perspective pictures that meet in vertical lines. As
// in Hugin the outer planes reach up to 89 degrees outwards from the way they face.
#ifdef __cplusplus
inline constexpr LensParameterInfo triplane_parameters[] = {
    {"angle_deg", 45, 1, 90, "angle between the ways that neighbouring planes face, degrees"},
};

inline constexpr LensInfo triplane_info = {
    .name = "triplane",
    .group = "panoramic",
    .also = "hugin_triplane",
    .formula =
        "to a/2 as perspective; beyond x = 2 tan(a/2) + tan(longitude - a), y = tan(latitude) / cos(longitude - a); "
        "mirrored on the left",
    .source = "Hugin Triplane (18), libpano13",
    .example = "triplane:fov_deg=170,angle_deg=60",
    .default_fov_deg = 180,
    .max_fov_deg = 358,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = triplane_parameters,
    .max_angle = [](const LensParameters& parameters) { return (parameters.k[0] + 89.0) * pi / 180.0; },
    .parts = [](const LensParameters& parameters) -> std::vector<PlanePolygon> {
      const double corner = std::tan(parameters.k[0] * pi / 360.0);
      return {{{-1e6, -1e6}, {-corner, -1e6}, {-corner, 1e6}, {-1e6, 1e6}},
              {{-corner, -1e6}, {corner, -1e6}, {corner, 1e6}, {-corner, 1e6}},
              {{corner, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {corner, 1e6}}};
    },
};
#endif

#ifndef __cplusplus
#include "models/biplane.h"
#endif

LENS_FUNCTION bool triplane_project(Params params, vec3 direction, OUT(vec2) plane) {
  real turn = radians(params.k[0]);
  real corner = tan(real(0.5) * turn);
  bool middle = abs(direction.x) <= corner * direction.z;
  real side = middle ? real(0.0) : direction.x < real(0.0) ? real(-1.0) : real(1.0);
  bool seen = turned_plane_project(side * turn, direction, plane);
  plane.x += real(2.0) * side * corner;
  return seen && within_angle(params, direction);
}

LENS_FUNCTION bool triplane_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real turn = radians(params.k[0]);
  real corner = tan(real(0.5) * turn);
  real side = abs(plane.x) <= corner ? real(0.0) : plane.x < real(0.0) ? real(-1.0) : real(1.0);
  vec2 point = vec2(plane.x - real(2.0) * side * corner, plane.y);
  bool seen = turned_plane_unproject(side * turn, point, direction);
  return seen && within_angle(params, direction);
}
