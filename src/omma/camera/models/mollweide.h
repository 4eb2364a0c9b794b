// Mollweide's projection: equal areas, the whole sphere in an ellipse of 2:1 with straight parallels.
//
// The auxiliary angle is solved for as u, twice its distance from the pole: u - sin u = π (1 - sin(latitude)). Near the
// poles that keeps the digits which the usual 2t + sin 2t = π sin(latitude) loses.
#ifdef __cplusplus
inline constexpr LensInfo mollweide_info = {
    .name = "mollweide",
    .group = "panoramic",
    .also = "homolographic, babinet",
    .formula = "x = 2√2/π longitude · cos t, y = √2 sin t, 2t + sin 2t = π sin(latitude)",
    .source = "Mollweide 1805; Snyder 1987, Map Projections, chapter 31",
    .example = "mollweide:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

// u - sin u, by its series where the difference would cancel.
LENS_FUNCTION real mollweide_area(real u) {
  real s = u * u;
  real series = real(1.0) - s / real(210.0);
  series = real(1.0) - s / real(156.0) * series;
  series = real(1.0) - s / real(110.0) * series;
  series = real(1.0) - s / real(72.0) * series;
  series = real(1.0) - s / real(42.0) * series;
  series = real(1.0) - s / real(20.0) * series;
  return u < real(1.0) ? u * s / real(6.0) * series : u - sin(u);
}

// The inverse, for 0 to pi. The function is convex there and at most u³/6, so that the first guess lies below the
// answer, the first step of Newton's method above it, and the others come down to it.
LENS_FUNCTION real mollweide_angle(real area) {
  if (area <= real(0.0)) return real(0.0);
  real u = min(pow(real(6.0) * area, real(1.0) / real(3.0)), lens_pi);
  for (int step = 0; step < 32; ++step) {
    real sine = sin(real(0.5) * u);
    real next = min(u - (mollweide_area(u) - area) / (real(2.0) * sine * sine), lens_pi);
    bool settled = abs(next - u) <= real(2.0) * lens_epsilon * u;
    u = next;
    if (settled) break;
  }
  return u;
}

LENS_FUNCTION bool mollweide_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec3 unit = direction / length(direction);
  real cosine2 = unit.x * unit.x + unit.z * unit.z;
  real half_angle = real(0.5) * mollweide_angle(lens_pi * cosine2 / (real(1.0) + abs(unit.y)));
  real root2 = sqrt(real(2.0));
  real height = root2 * cos(half_angle);
  plane = vec2(real(2.0) * root2 / lens_pi * longitude_of(direction) * sin(half_angle),
               direction.y < real(0.0) ? -height : height);
  return within_angle(params, direction);
}

LENS_FUNCTION bool mollweide_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real root2 = sqrt(real(2.0));
  real height = abs(plane.y) / root2;
  real across = sqrt(max(real(0.0), (real(1.0) - height) * (real(1.0) + height)));
  real longitude = across > real(0.0) ? plane.x * lens_pi / (real(2.0) * root2 * across) : real(0.0);
  real below_pole = mollweide_area(real(2.0) * atan(across, height)) / lens_pi;  // 1 - sin(latitude)
  real sine = real(1.0) - below_pole;
  real cosine = sqrt(below_pole * (real(2.0) - below_pole));
  direction = vec3(cosine * sin(longitude), plane.y < real(0.0) ? -sine : sine, cosine * cos(longitude));
  return height <= real(1.0) && abs(plane.x) <= real(2.0) * root2 * across && within_angle(params, direction);
}
