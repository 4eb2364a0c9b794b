// Winkel's third projection: the mean of Aitoff's and the equirectangular one, a compromise between the errors of area,
// direction and distance. The standard parallel is Winkel's own, cos φ1 = 2/π.
#ifdef __cplusplus
inline constexpr LensInfo winkel_tripel_info = {
    .name = "winkel_tripel",
    .group = "panoramic",
    .also = "winkel, winkel3",
    .formula =
        "x = (longitude · 2/π + 2 cos(latitude) sin(longitude/2) α/sin α) / 2, y = (latitude + sin(latitude) α/sin α) "
        "/ 2, cos α = cos(latitude) cos(longitude/2)",
    .source = "Winkel 1921; Snyder, Voxland 1989, An Album of Map Projections, 164; Ipbüker, Bildirici 2002 (inverse)",
    .example = "winkel_tripel:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

// α/sin α and its derivative by cos α, for α up to a right angle; α is in the series w = 1 - cos α where the closed
// forms would divide zero by zero.
LENS_FUNCTION vec2 winkel_tripel_stretch(real sine, real cosine) {
  real w = sine * sine / (real(1.0) + cosine);
  real stretch = sine > real(0.0) ? atan(sine, cosine) / sine : real(1.0);
  real slope = real(-1.0) / real(3.0) - w * (real(4.0) / real(15.0) + w * (real(6.0) / real(35.0)));
  if (w > real(0.01)) slope = (cosine * stretch - real(1.0)) / (sine * sine);
  return vec2(stretch, slope);
}

LENS_FUNCTION vec2 winkel_tripel_point(real longitude, real latitude) {
  vec3 halved = direction_at(real(0.5) * longitude, latitude);
  real stretch = winkel_tripel_stretch(length(vec2(halved.x, halved.y)), halved.z).x;
  return vec2(longitude / lens_pi + halved.x * stretch, real(0.5) * (latitude + halved.y * stretch));
}

LENS_FUNCTION bool winkel_tripel_project(Params params, vec3 direction, OUT(vec2) plane) {
  plane = winkel_tripel_point(longitude_of(direction), latitude_of(direction));
  return within_angle(params, direction);
}

// Newton's method in both angles. Steps end at the border of a slightly wider map, where the formula still holds, so
// that a point outside the map ends beyond 180 degrees or away from where it should be.
LENS_FUNCTION bool winkel_tripel_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real right_angle = real(0.5) * lens_pi;
  real longitude = clamp(real(1.2) * plane.x, -lens_pi, lens_pi);
  real latitude = clamp(plane.y, -right_angle, right_angle);
  real error = real(1.0);
  for (int step = 0; step < 24; ++step) {
    vec2 residual = winkel_tripel_point(longitude, latitude) - plane;
    error = length(residual);
    real sine = sin(real(0.5) * longitude);
    real cosine = cos(real(0.5) * longitude);
    real across = cos(latitude);
    real up = sin(latitude);
    vec2 stretch = winkel_tripel_stretch(length(vec2(across * sine, up)), across * cosine);
    real by_longitude = real(-0.5) * across * sine * stretch.y;
    real by_latitude = -up * cosine * stretch.y;
    real x_longitude = real(1.0) / lens_pi + across * (real(0.5) * cosine * stretch.x + sine * by_longitude);
    real x_latitude = sine * (across * by_latitude - up * stretch.x);
    real y_longitude = real(0.5) * up * by_longitude;
    real y_latitude = real(0.5) * (real(1.0) + across * stretch.x + up * by_latitude);
    real determinant = x_longitude * y_latitude - x_latitude * y_longitude;
    real longitude_step = (residual.x * y_latitude - residual.y * x_latitude) / determinant;
    real latitude_step = (residual.y * x_longitude - residual.x * y_longitude) / determinant;
    longitude = clamp(longitude - longitude_step, real(-1.05) * lens_pi, real(1.05) * lens_pi);
    latitude = clamp(latitude - latitude_step, real(-1.05) * right_angle, real(1.05) * right_angle);
    if (abs(longitude_step) + abs(latitude_step) <= real(4.0) * lens_epsilon) break;
  }
  direction = direction_at(longitude, latitude);
  return error < real(1e-4) && abs(longitude) <= lens_pi && abs(latitude) <= right_angle &&
         within_angle(params, direction);
}
