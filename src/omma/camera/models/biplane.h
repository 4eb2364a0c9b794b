// Two planes side by side that meet ahead: each a perspective picture, so that straight lines bend only where they
// cross the corner. As in Hugin each plane reaches up to 89 degrees outwards from the way it faces.
#ifdef __cplusplus
inline constexpr LensParameterInfo biplane_parameters[] = {
    {"angle_deg", 45, 1, 170, "angle between the ways the two planes face, degrees"},
};

inline constexpr LensInfo biplane_info = {
    .name = "biplane",
    .group = "panoramic",
    .also = "hugin_biplane",
    .formula = "x = tan(a/2) + tan(longitude - a/2), y = tan(latitude) / cos(longitude - a/2); mirrored on the left",
    .source = "Hugin Biplane (17), libpano13",
    .example = "biplane:fov_deg=150,angle_deg=60",
    .default_fov_deg = 140,
    .max_fov_deg = 348,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = biplane_parameters,
    .max_angle = [](const LensParameters& parameters) { return (0.5 * parameters.k[0] + 89.0) * pi / 180.0; },
    .parts = [](const LensParameters&) -> std::vector<PlanePolygon> {
      return {{{-1e6, -1e6}, {0.0, -1e6}, {0.0, 1e6}, {-1e6, 1e6}}, {{0.0, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {0.0, 1e6}}};
    },
};
#endif

// A plane at distance 1 that faces `turn` radians to the right of ahead.
LENS_FUNCTION bool turned_plane_project(real turn, vec3 direction, OUT(vec2) plane) {
  real across = direction.x * cos(turn) - direction.z * sin(turn);
  real ahead = direction.x * sin(turn) + direction.z * cos(turn);
  // The tangent of 89 degrees to the side, nearly the zenith upwards.
  bool seen =
      ahead > real(0.0) && abs(across) <= real(57.289961630759425) * ahead && abs(direction.y) < real(1e6) * ahead;
  plane = seen ? vec2(across, direction.y) / ahead : vec2(real(0.0));
  return seen;
}

LENS_FUNCTION bool turned_plane_unproject(real turn, vec2 plane, OUT(vec3) direction) {
  direction = normalize(vec3(plane.x * cos(turn) + sin(turn), plane.y, cos(turn) - plane.x * sin(turn)));
  return abs(plane.x) <= real(57.289961630759425) && abs(plane.y) < real(1e6);
}

LENS_FUNCTION bool biplane_project(Params params, vec3 direction, OUT(vec2) plane) {
  real turn = radians(real(0.5) * params.k[0]);
  real side = direction.x < real(0.0) ? real(-1.0) : real(1.0);
  bool seen = turned_plane_project(side * turn, direction, plane);
  plane.x += side * tan(turn);
  return seen && within_angle(params, direction);
}

LENS_FUNCTION bool biplane_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real turn = radians(real(0.5) * params.k[0]);
  real side = plane.x < real(0.0) ? real(-1.0) : real(1.0);
  bool seen = turned_plane_unproject(side * turn, vec2(plane.x - side * tan(turn), plane.y), direction);
  return seen && within_angle(params, direction);
}
