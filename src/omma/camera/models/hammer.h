// Hammer's projection (Hammer-Aitoff): equal areas, the whole sphere in an ellipse of 2:1. It is Lambert's azimuthal
// equal-area projection of the directions with halved longitude, stretched to twice the width.
#ifdef __cplusplus
inline constexpr LensInfo hammer_info = {
    .name = "hammer",
    .group = "panoramic",
    .also = "hammer_aitoff",
    .formula =
        "x = 2√2 cos(latitude) sin(longitude/2) / w, y = √2 sin(latitude) / w, w² = 1 + cos(latitude) cos(longitude/2)",
    .source = "Hammer 1892; Snyder 1987, Map Projections, chapter 24; Hugin Hammer-Aitoff (21)",
    .example = "hammer:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool hammer_project(Params params, vec3 direction, OUT(vec2) plane) {
  real half_longitude = real(0.5) * longitude_of(direction);
  real rho = length(vec2(direction.x, direction.z));
  vec3 halved = vec3(rho * sin(half_longitude), direction.y, rho * cos(half_longitude)) / length(direction);
  plane = vec2(real(2.0) * halved.x, halved.y) * sqrt(real(2.0) / (real(1.0) + halved.z));
  return within_angle(params, direction);
}

LENS_FUNCTION bool hammer_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  vec2 point = vec2(real(0.5) * plane.x, plane.y);
  real r2 = dot(point, point);
  real w = sqrt(max(real(0.0), real(1.0) - real(0.25) * r2));
  vec3 halved = vec3(point.x * w, point.y * w, real(1.0) - real(0.5) * r2);
  // Doubles the longitude: (s, c) -> (2 s c, c² - s²), with the length rho of (s, c).
  real rho = length(vec2(halved.x, halved.z));
  real scale = rho > real(0.0) ? real(1.0) / rho : real(0.0);
  direction =
      vec3(real(2.0) * halved.x * halved.z * scale, halved.y, (halved.z - halved.x) * (halved.z + halved.x) * scale);
  return r2 <= real(2.0) && within_angle(params, direction);
}
