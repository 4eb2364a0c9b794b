// Sinusoidal projection, Sanson's and Flamsteed's: equal areas, parallels evenly spaced and of true length.
#ifdef __cplusplus
inline constexpr LensInfo sinusoidal_info = {
    .name = "sinusoidal",
    .group = "panoramic",
    .also = "sanson_flamsteed, mercator_equal_area",
    .formula = "x = longitude · cos(latitude), y = latitude",
    .source = "Snyder 1987, Map Projections, chapter 30; Hugin Sinusoidal (7)",
    .example = "sinusoidal:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool sinusoidal_project(Params params, vec3 direction, OUT(vec2) plane) {
  real latitude = latitude_of(direction);
  real cosine = length(vec2(direction.x, direction.z)) / length(direction);
  plane = vec2(longitude_of(direction) * cosine, latitude);
  return within_angle(params, direction);
}

LENS_FUNCTION bool sinusoidal_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real cosine = max(cos(plane.y), real(0.0));
  real longitude = cosine > real(0.0) ? plane.x / cosine : real(0.0);
  direction = direction_at(longitude, plane.y);
  return abs(plane.x) <= lens_pi * cosine && abs(plane.y) <= real(0.5) * lens_pi && within_angle(params, direction);
}
