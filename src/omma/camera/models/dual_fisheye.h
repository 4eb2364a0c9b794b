// Two equidistant fisheyes back to back, side by side in the image: behind at the left, ahead at the right. Over 180
// degrees they overlap, and a direction is drawn where it is nearer to the middle.
#ifdef __cplusplus
inline constexpr LensParameterInfo dual_fisheye_parameters[] = {
    {"circle_fov_deg", 180, 1, 360, "field of view of each of the two, degrees"},
};

inline constexpr LensInfo dual_fisheye_info = {
    .name = "dual_fisheye",
    .group = "layout",
    .also = "dfisheye",
    .formula = "r = 2 θ / circle_fov in circles of radius 1 around (-1, 0) and (1, 0), θ from behind and from ahead",
    .source = "ffmpeg v360 dfisheye",
    .example = "dual_fisheye:width=960,height=480,circle_fov_deg=195",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = dual_fisheye_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-2.0, -1.0}, {2.0, 1.0}};
    },
    .parts = [](const LensParameters&) { return plane_squares(2, 1); },
};
#endif

LENS_FUNCTION bool dual_fisheye_project(Params params, vec3 direction, OUT(vec2) plane) {
  bool ahead = direction.z >= real(0.0);
  vec2 across = vec2(ahead ? direction.x : -direction.x, direction.y);
  real rho = length(across);
  real r = real(2.0) * atan(rho, abs(direction.z)) / radians(params.k[0]);
  plane = vec2(ahead ? real(1.0) : real(-1.0), real(0.0)) + (rho > real(0.0) ? across * (r / rho) : vec2(real(0.0)));
  return r <= real(1.0) + real(4.0) * lens_epsilon && within_angle(params, direction);
}

LENS_FUNCTION bool dual_fisheye_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  bool ahead = plane.x >= real(0.0);
  vec2 across = vec2(ahead ? plane.x - real(1.0) : -plane.x - real(1.0), plane.y);
  real r = length(across);
  real theta = real(0.5) * r * radians(params.k[0]);
  real scale = r > real(0.0) ? sin(theta) / r : real(0.0);
  direction = vec3(across.x * scale, across.y * scale, ahead ? cos(theta) : -cos(theta));
  return r <= real(1.0) && within_angle(params, direction);
}
