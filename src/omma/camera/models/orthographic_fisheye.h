// Orthographic fisheye, the cosine sphere: the unit hemisphere of directions seen from infinitely far away.
#ifdef __cplusplus
inline constexpr LensInfo orthographic_fisheye_info = {
    .name = "orthographic_fisheye",
    .group = "radial",
    .also = "orthographic, og, cosine_sphere",
    .formula = "r = sin θ",
    .source = "Snyder 1987, Map Projections, chapter 20",
    .example = "orthographic_fisheye:fov_deg=180",
    .default_fov_deg = 180,
    .max_fov_deg = 180,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi / 2; },
};
#endif

LENS_FUNCTION bool orthographic_fisheye_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, sin(theta), plane);
}

LENS_FUNCTION bool orthographic_fisheye_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real sine = length(plane);
  real cosine = sqrt(max(real(0.0), (real(1.0) - sine) * (real(1.0) + sine)));
  real theta = atan(sine, cosine);
  return radial_unproject(params, plane, theta, direction) && sine <= real(1.0);
}
