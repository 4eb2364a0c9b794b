// Mercator's projection: conformal, angles stay what they are everywhere. It never reaches the poles.
#ifdef __cplusplus
inline constexpr LensInfo mercator_info = {
    .name = "mercator",
    .group = "panoramic",
    .also = "cylindrical_conformal",
    .formula = "x = longitude, y = ln tan(45° + latitude/2)",
    .source = "Mercator 1569; Snyder 1987, Map Projections, chapter 7; Hugin Mercator (5)",
    .example = "mercator:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool mercator_project(Params params, vec3 direction, OUT(vec2) plane) {
  real rho = length(vec2(direction.x, direction.z));
  bool below_pole = abs(direction.y) < real(1e6) * rho;
  plane = vec2(longitude_of(direction), below_pole ? asinh(direction.y / rho) : real(0.0));
  return below_pole && within_angle(params, direction);
}

LENS_FUNCTION bool mercator_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  bool below_pole = abs(plane.y) < real(14.5);  // asinh 1e6
  direction = normalize(vec3(sin(plane.x), below_pole ? sinh(plane.y) : real(0.0), cos(plane.x)));
  return below_pole && abs(plane.x) <= lens_pi && within_angle(params, direction);
}
