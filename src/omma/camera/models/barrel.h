// Barrel, once Facebook's format: the band within 45 degrees of the horizon as an equirectangular picture in the left
// four fifths of the image, and beside it the zenith above the nadir as in a cube map, seen up to its circle. Each part
// is made smaller by `scale` around its middle; what lies between shows the same world again, for filtering.
#ifdef __cplusplus
inline constexpr LensParameterInfo barrel_parameters[] = {
    {"scale", 0.99, 0.5, 1, "how much of the width and height of its part each part takes"},
};

inline constexpr LensInfo barrel_info = {
    .name = "barrel",
    .group = "layout",
    .also = "fb",
    .formula = "left 4/5: longitude / 180°, latitude / 45°; right 1/5: up above down, x/y and z/y",
    .source = "ffmpeg v360 barrel",
    .example = "barrel:width=800,height=320,scale=0.98",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = barrel_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-2.5, -1.0}, {2.5, 1.0}};
    },
    .parts = [](const LensParameters&) -> std::vector<PlanePolygon> {
      return {{{-2.5, -1.0}, {1.5, -1.0}, {1.5, 1.0}, {-2.5, 1.0}},
              {{1.5, -1.0}, {2.5, -1.0}, {2.5, 0.0}, {1.5, 0.0}},
              {{1.5, 0.0}, {2.5, 0.0}, {2.5, 1.0}, {1.5, 1.0}}};
    },
};
#endif

LENS_FUNCTION bool barrel_project(Params params, vec3 direction, OUT(vec2) plane) {
  real rho = length(vec2(direction.x, direction.z));
  real scale = params.k[0];
  if (abs(direction.y) <= rho) {
    plane = vec2(real(2.0) * scale * longitude_of(direction) / lens_pi - real(0.5),
                 scale * latitude_of(direction) * (real(4.0) / lens_pi));
  } else {
    bool down = direction.y > real(0.0);
    vec2 cap = vec2(direction.x, down ? -direction.z : direction.z) / abs(direction.y);
    plane = vec2(real(2.0), down ? real(0.5) : real(-0.5)) + real(0.5) * scale * cap;
  }
  return within_angle(params, direction);
}

LENS_FUNCTION bool barrel_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real scale = params.k[0];
  if (plane.x < real(1.5)) {
    direction =
        direction_at((plane.x + real(0.5)) * lens_pi / (real(2.0) * scale), plane.y * lens_pi / (real(4.0) * scale));
  } else {
    bool down = plane.y >= real(0.0);
    vec2 cap = (plane - vec2(real(2.0), down ? real(0.5) : real(-0.5))) * (real(2.0) / scale);
    direction = normalize(vec3(cap.x, down ? real(1.0) : real(-1.0), down ? -cap.y : cap.y));
  }
  return abs(plane.x) <= real(2.5) && abs(plane.y) <= real(1.0) && within_angle(params, direction);
}
