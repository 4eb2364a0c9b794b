// Miller's cylindrical projection: Mercator's with latitudes shortened, so that the poles are in the image.
#ifdef __cplusplus
inline constexpr LensInfo miller_info = {
    .name = "miller",
    .group = "panoramic",
    .also = "miller_cylindrical",
    .formula = "x = longitude, y = 5/4 ln tan(45° + 2/5 latitude)",
    .source = "Miller 1942; Snyder 1987, Map Projections, chapter 11; Hugin Miller cylindrical (11)",
    .example = "miller:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION real miller_height(real latitude) { return real(1.25) * asinh(tan(real(0.8) * latitude)); }

LENS_FUNCTION real miller_latitude(real height) {
  return real(1.25) * atan(sinh(real(0.8) * clamp(height, real(-3.0), real(3.0))));
}

LENS_FUNCTION bool miller_project(Params params, vec3 direction, OUT(vec2) plane) {
  plane = vec2(longitude_of(direction), miller_height(latitude_of(direction)));
  return within_angle(params, direction);
}

LENS_FUNCTION bool miller_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real latitude = miller_latitude(plane.y);
  direction = direction_at(plane.x, latitude);
  return abs(plane.x) <= lens_pi && abs(latitude) <= real(0.5) * lens_pi && within_angle(params, direction);
}
