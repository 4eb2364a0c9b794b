// Octahedral map: the sphere on an octahedron around it, unfolded into a square. The front half is the diamond in the
// middle, the back half its corners.
#ifdef __cplusplus
inline constexpr LensInfo octahedral_info = {
    .name = "octahedral",
    .group = "layout",
    .also = "octahedron",
    .formula = "(x, y) = (dx, dy) / (abs dx + abs dy + abs dz), folded over the edges of the diamond behind",
    .source =
        "Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit Vectors; ffmpeg v360 "
        "octahedron",
    .example = "octahedral:width=480,height=480",
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

// Swaps the inside and the outside of the diamond |x| + |y| = 1 in each quadrant.
LENS_FUNCTION vec2 octahedral_fold(vec2 point) {
  return vec2((real(1.0) - abs(point.y)) * (point.x < real(0.0) ? real(-1.0) : real(1.0)),
              (real(1.0) - abs(point.x)) * (point.y < real(0.0) ? real(-1.0) : real(1.0)));
}

LENS_FUNCTION bool octahedral_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec3 size = abs(direction);
  plane = vec2(direction.x, direction.y) / (size.x + size.y + size.z);
  if (direction.z < real(0.0)) plane = octahedral_fold(plane);
  return within_angle(params, direction);
}

LENS_FUNCTION bool octahedral_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real ahead = real(1.0) - abs(plane.x) - abs(plane.y);
  vec2 across = ahead < real(0.0) ? octahedral_fold(plane) : plane;
  direction = normalize(vec3(across.x, across.y, ahead));
  return abs(plane.x) <= real(1.0) && abs(plane.y) <= real(1.0) && within_angle(params, direction);
}
