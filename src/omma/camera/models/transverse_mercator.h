// Transverse Mercator: Mercator's cylinder laid on its side. Conformal, true along the meridian ahead, which may run
// over the zenith, behind and through the nadir; it never reaches the points straight left and right.
#ifdef __cplusplus
inline constexpr LensInfo transverse_mercator_info = {
    .name = "transverse_mercator",
    .group = "panoramic",
    .also = "trans_mercator, gauss_lambert",
    .formula = "x = artanh(sin(longitude) cos(latitude)), y = atan2(tan(latitude), cos(longitude))",
    .source = "Lambert 1772; Snyder 1987, Map Projections, chapter 8; Hugin Transverse Mercator (6)",
    .example = "transverse_mercator:fov_deg=150",
    .default_fov_deg = 140,
    .max_fov_deg = 180,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool transverse_mercator_project(Params params, vec3 direction, OUT(vec2) plane) {
  real rho = length(vec2(direction.y, direction.z));
  bool between = abs(direction.x) < real(1e6) * rho;
  plane = between ? vec2(asinh(direction.x / rho), atan(direction.y, direction.z)) : vec2(real(0.0));
  return between && within_angle(params, direction);
}

LENS_FUNCTION bool transverse_mercator_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  bool between = abs(plane.x) < real(14.5);  // asinh 1e6
  direction = normalize(vec3(between ? sinh(plane.x) : real(0.0), sin(plane.y), cos(plane.y)));
  return between && abs(plane.y) <= lens_pi && within_angle(params, direction);
}
