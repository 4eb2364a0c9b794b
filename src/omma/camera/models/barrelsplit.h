// The barrel in two halves: in the left two thirds of the image the band within 45 degrees of the horizon, its front
// above its back, and in the right third the halves of the zenith's and the nadir's cube faces: front zenith, front
// nadir, back zenith, back nadir. `scale` is 1 - out_pad of ffmpeg: what it leaves at the parts' borders shows the same
// world again, for filtering. The heights of the caps take it twice, as ffmpeg does.
#ifdef __cplusplus
inline constexpr LensParameterInfo barrelsplit_parameters[] = {
    {"scale", 1, 0.75, 1, "how much of the width of its part each part takes; ffmpeg's 1 - out_pad"},
};

inline constexpr LensInfo barrelsplit_info = {
    .name = "barrelsplit",
    .group = "layout",
    .also = "barrel_split",
    .formula = "left 2/3: front above back, longitude / 90°, latitude / 45°; right 1/3: x/y and z/y, front above back",
    .source = "ffmpeg v360 barrelsplit",
    .example = "barrelsplit:width=600,height=400,scale=0.95",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = barrelsplit_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-1.5, -1.0}, {1.5, 1.0}};
    },
    .parts = [](const LensParameters&) -> std::vector<PlanePolygon> {
      return {{{-1.5, -1.0}, {0.5, -1.0}, {0.5, 0.0}, {-1.5, 0.0}}, {{-1.5, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {-1.5, 1.0}},
              {{0.5, -1.0}, {1.5, -1.0}, {1.5, -0.5}, {0.5, -0.5}}, {{0.5, -0.5}, {1.5, -0.5}, {1.5, 0.0}, {0.5, 0.0}},
              {{0.5, 0.0}, {1.5, 0.0}, {1.5, 0.5}, {0.5, 0.5}},     {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.0}, {0.5, 1.0}}};
    },
};
#endif

// Stays off the borders of a part by a few roundings: the other side of them is elsewhere in the world.
LENS_FUNCTION vec2 barrelsplit_within(vec2 part) {
  real border = real(1.0) - real(32.0) * lens_epsilon;
  return clamp(part, vec2(-border), vec2(border));
}

LENS_FUNCTION bool barrelsplit_project(Params params, vec3 direction, OUT(vec2) plane) {
  real scale = params.k[0];
  bool back = direction.z < real(0.0);
  // Seen from the front or, after half a turn, from the back.
  vec2 level = back ? vec2(-direction.x, -direction.z) : vec2(direction.x, direction.z);
  real rho = length(level);
  if (abs(direction.y) <= rho) {
    vec2 part = vec2(atan(level.x, level.y), real(2.0) * atan(direction.y, rho)) * (real(2.0) * scale / lens_pi);
    plane = vec2(real(-0.5), back ? real(0.5) : real(-0.5)) + vec2(real(1.0), real(0.5)) * barrelsplit_within(part);
  } else {
    bool down = direction.y > real(0.0);
    vec2 cap = level / abs(direction.y);
    real along = real(2.0) * scale * (cap.y * scale - real(1.0)) + real(1.0);
    vec2 part = vec2(cap.x * scale, down ? -along : along);
    real middle = (back ? real(0.25) : real(-0.75)) + (down ? real(0.5) : real(0.0));
    plane = vec2(real(1.0), middle) + vec2(real(0.5), real(0.25)) * barrelsplit_within(part);
  }
  return within_angle(params, direction);
}

LENS_FUNCTION bool barrelsplit_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real scale = params.k[0];
  bool back = plane.y >= real(0.0);
  if (plane.x < real(0.5)) {
    vec2 part = vec2(plane.x + real(0.5), real(2.0) * plane.y + (back ? real(-1.0) : real(1.0)));
    direction = direction_at(part.x * lens_pi / (real(2.0) * scale), part.y * lens_pi / (real(4.0) * scale));
  } else {
    bool down = plane.y >= (back ? real(0.5) : real(-0.5));
    real middle = (back ? real(0.25) : real(-0.75)) + (down ? real(0.5) : real(0.0));
    real along = real(4.0) * (down ? middle - plane.y : plane.y - middle);
    vec2 cap =
        vec2(real(2.0) * (plane.x - real(1.0)) / scale, (real(0.5) * (along - real(1.0)) / scale + real(1.0)) / scale);
    direction = normalize(vec3(cap.x, down ? real(1.0) : real(-1.0), cap.y));
  }
  if (back) direction = vec3(-direction.x, direction.y, -direction.z);
  return abs(plane.x) <= real(1.5) && abs(plane.y) <= real(1.0) && within_angle(params, direction);
}
