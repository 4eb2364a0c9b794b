// Tetrahedral map: the sphere on a tetrahedron around it, unfolded into a rectangle.
#ifdef __cplusplus
inline constexpr LensInfo tetrahedral_info = {
    .name = "tetrahedral",
    .group = "layout",
    .also = "tetrahedron",
    .formula =
        "on the face: X = 4u - 1 or 3 - 4u, Y = 1 - 2v, Z = 2 abs(1 - abs(1 - 2u + v)) - 1 with u and v from 0 to 1",
    .source = "ffmpeg v360 tetrahedron",
    .example = "tetrahedral:width=640,height=480",
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
      return {{{-1.0, -1.0}, {0.0, -1.0}, {0.0, 1.0}},
              {{-1.0, -1.0}, {0.0, 1.0}, {-1.0, 1.0}},
              {{0.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}},
              {{0.0, -1.0}, {1.0, 1.0}, {0.0, 1.0}}};
    },
};
#endif

LENS_FUNCTION real tetrahedral_depth(real u, real v) {
  return real(2.0) * abs(real(1.0) - abs(real(1.0) - real(2.0) * u + v)) - real(1.0);
}

// The nearest of the four faces is where the direction meets the tetrahedron. On it x decides on two columns of the
// image, and the depth between them.
LENS_FUNCTION bool tetrahedral_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec3 d = direction;
  real nearest = max(max(d.x + d.y - d.z, -d.x - d.y - d.z), max(d.x - d.y + d.z, -d.x + d.y + d.z));
  vec3 point = d / nearest;
  real v = real(0.5) - real(0.5) * point.y;
  real left = real(0.25) + real(0.25) * point.x;
  real right = real(0.75) - real(0.25) * point.x;
  bool in_left = abs(tetrahedral_depth(left, v) - point.z) <= abs(tetrahedral_depth(right, v) - point.z);
  plane = vec2(real(2.0) * (in_left ? left : right) - real(1.0), -point.y);
  return within_angle(params, direction);
}

LENS_FUNCTION bool tetrahedral_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real u = real(0.5) + real(0.5) * plane.x;
  real v = real(0.5) + real(0.5) * plane.y;
  real x = u < real(0.5) ? real(4.0) * u - real(1.0) : real(3.0) - real(4.0) * u;
  direction = normalize(vec3(x, -plane.y, tetrahedral_depth(u, v)));
  return abs(plane.x) <= real(1.0) && abs(plane.y) <= real(1.0) && within_angle(params, direction);
}
