// Equidistant fisheye, "f-theta": the image radius is proportional to the angle from the axis.
#ifdef __cplusplus
inline constexpr LensInfo equidistant_info = {
    .name = "equidistant",
    .group = "radial",
    .also = "fisheye, fisheye_equidistant, simple_fisheye, linear_fisheye, equiangular",
    .formula = "r = θ",
    .source = "Gascuel et al. 2008, table 1, fish-eye (2)",
    .example = "equidistant:fov_deg=180",
    .default_fov_deg = 180,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool equidistant_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, theta, plane);
}

LENS_FUNCTION bool equidistant_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real theta = length(plane);
  return radial_unproject(params, plane, theta, direction);
}
