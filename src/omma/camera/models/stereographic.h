// Stereographic fisheye, what a paraboloid mirror shows: conformal, circles on the sphere stay circles.
// Pointed straight down with a field of view around 300 degrees it shows a little planet.
#ifdef __cplusplus
inline constexpr LensInfo stereographic_info = {
    .name = "stereographic",
    .group = "radial",
    .also = "sg, paraboloid, conformal_fisheye, little_planet",
    .formula = "r = 2 tan(θ/2)",
    .source = "Snyder 1987, Map Projections, chapter 21; Heidrich, Seidel 1998 (paraboloid)",
    .example = "stereographic:fov_deg=220",
    .default_fov_deg = 180,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi - open_end; },
};
#endif

LENS_FUNCTION bool stereographic_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, real(2.0) * tan(real(0.5) * theta), plane);
}

LENS_FUNCTION bool stereographic_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real theta = real(2.0) * atan(real(0.5) * length(plane), real(1.0));
  return radial_unproject(params, plane, theta, direction);
}
