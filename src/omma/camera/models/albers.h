// Albers' equal-area conic projection: equal areas, least distorted between its two standard parallels. With opposite
// parallels it is the cylindrical equal-area projection; the formulae are written so that they hold there too.
#ifdef __cplusplus
inline constexpr LensParameterInfo albers_parameters[] = {
    {"parallel1_deg", 29.5, -80, 80, "first standard parallel, degrees of latitude, north positive"},
    {"parallel2_deg", 45.5, -80, 80, "second standard parallel, degrees of latitude, north positive"},
};

inline constexpr LensInfo albers_info = {
    .name = "albers",
    .group = "panoramic",
    .also = "albers_equal_area_conic, albers_conic",
    .formula =
        "x = s sin(n · longitude) / n, y = (√C - s cos(n · longitude)) / n, s² = C - 2n sin(latitude), n = (sin p1 + "
        "sin p2) / 2, C = 1 + sin p1 sin p2",
    .source = "Albers 1805; Snyder 1987, Map Projections, chapter 14; Hugin Albers equal area conic (10)",
    .example = "albers:fov_deg=180,parallel1_deg=20,parallel2_deg=50",
    .default_fov_deg = 180,
    .max_fov_deg = 180,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = albers_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool albers_project(Params params, vec3 direction, OUT(vec2) plane) {
  real sine1 = sin(radians(params.k[0]));
  real sine2 = sin(radians(params.k[1]));
  real n = real(0.5) * (sine1 + sine2);
  real c = real(1.0) + sine1 * sine2;
  real north = -direction.y / length(direction);
  real s = sqrt(c - real(2.0) * n * north);
  // sin(a)/n and (1 - cos(a))/n with a = n * longitude, written so that n may be zero.
  real longitude = longitude_of(direction);
  real half_turn = real(0.5) * n * longitude;
  real chord = half_turn == real(0.0) ? real(0.5) * longitude : sin(half_turn) / n;
  real up = real(2.0) * north / (sqrt(c) + s) + real(2.0) * s * chord * sin(half_turn);
  plane = vec2(real(2.0) * s * chord * cos(half_turn), -up);
  return within_angle(params, direction);
}

LENS_FUNCTION bool albers_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real sine1 = sin(radians(params.k[0]));
  real sine2 = sin(radians(params.k[1]));
  real n = real(0.5) * (sine1 + sine2);
  real root = sqrt(real(1.0) + sine1 * sine2);
  real from_apex = root + n * plane.y;
  real turn = atan(n * plane.x, from_apex);
  real longitude = n == real(0.0) ? plane.x / root : turn / n;
  real north = -root * plane.y - real(0.5) * n * dot(plane, plane);
  real cosine = sqrt(max(real(0.0), (real(1.0) - north) * (real(1.0) + north)));
  direction = vec3(cosine * sin(longitude), -north, cosine * cos(longitude));
  return abs(longitude) <= lens_pi && abs(north) <= real(1.0) && within_angle(params, direction);
}
