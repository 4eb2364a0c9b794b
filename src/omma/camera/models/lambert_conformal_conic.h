// Lambert's conformal conic projection: equal angles, true to scale on its two standard parallels. With opposite
// parallels it is Mercator's; the formulae are written so that they hold there too. With q the height on Mercator's map
// they are those of Snyder, his ρ being c exp(-n q) / n.
#ifdef __cplusplus
inline constexpr LensParameterInfo lambert_conformal_conic_parameters[] = {
    {"parallel1_deg", 29.5, -80, 80, "first standard parallel, degrees of latitude, north positive"},
    {"parallel2_deg", 45.5, -80, 80, "second standard parallel, degrees of latitude, north positive"},
};

inline constexpr LensInfo lambert_conformal_conic_info = {
    .name = "lambert_conformal_conic",
    .group = "panoramic",
    .also = "lambert_conformal, lcc",
    .formula =
        "x = ρ sin(n · longitude), y = ρ(0) - ρ cos(n · longitude), ρ = c / n · tan(45° + latitude/2)^-n, n = ln(cos "
        "p1 "
        "/ cos p2) / ln(tan(45° + p2/2) / tan(45° + p1/2)), c = cos p1 tan(45° + p1/2)^n",
    .source = "Lambert 1772; Snyder 1987, Map Projections, chapter 15",
    .example = "lambert_conformal_conic:fov_deg=160,parallel1_deg=20,parallel2_deg=50",
    .default_fov_deg = 180,
    .max_fov_deg = 180,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = lambert_conformal_conic_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
    // The cone's constant n, and c.
    .derive =
        [](LensParameters& parameters) {
          const double p1 = parameters.k[0] * pi / 180.0, p2 = parameters.k[1] * pi / 180.0;
          const double q1 = std::asinh(std::tan(p1)), q2 = std::asinh(std::tan(p2));
          // Parallels so close that the quotient would be of rounding errors have their middle's tangent cone.
          const double n = std::abs(p2 - p1) < 1e-5 ? std::sin(0.5 * (p1 + p2))
                                                    : (std::log(std::cos(p1)) - std::log(std::cos(p2))) / (q2 - q1);
          parameters.k[2] = n;
          parameters.k[3] = std::cos(p1) * std::exp(n * q1);
        },
};
#endif

// sinh keeps its digits for small numbers only where the driver takes care.
LENS_FUNCTION real conformal_sinh(real x) {
  real s = x * x;
  real series = real(1.0) + s / real(110.0) * (real(1.0) + s / real(156.0) * (real(1.0) + s / real(210.0)));
  series = real(1.0) + s / real(42.0) * (real(1.0) + s / real(72.0) * series);
  series = real(1.0) + s / real(6.0) * (real(1.0) + s / real(20.0) * series);
  return abs(x) < real(0.5) ? x * series : real(0.5) * (exp(x) - exp(-x));
}

// ln(1 + w), the same.
LENS_FUNCTION real conformal_log1p(real w) {
  real t = w / (real(2.0) + w);
  real s = t * t;
  real series = real(1.0) / real(9.0) + s * (real(1.0) / real(11.0) + s / real(13.0));
  series = real(1.0) / real(3.0) + s * (real(1.0) / real(5.0) + s * (real(1.0) / real(7.0) + s * series));
  return abs(w) < real(0.1) ? real(2.0) * t * (real(1.0) + s * series) : log(real(1.0) + w);
}

LENS_FUNCTION bool lambert_conformal_conic_project(Params params, vec3 direction, OUT(vec2) plane) {
  real n = params.k[2];
  real c = params.k[3];
  real rho = length(vec2(direction.x, direction.z));
  bool below_pole = abs(direction.y) < real(1e6) * rho;
  real q = below_pole ? asinh(-direction.y / rho) : real(0.0);
  // sin(a)/n and (1 - cos(a))/n with a = n * longitude, and (1 - exp(-n q))/n, so that n may be zero.
  real longitude = longitude_of(direction);
  real half_turn = real(0.5) * n * longitude;
  real chord = half_turn == real(0.0) ? real(0.5) * longitude : sin(half_turn) / n;
  real half_rise = real(0.5) * n * q;
  real rise = half_rise == real(0.0) ? real(0.5) * q : conformal_sinh(half_rise) / n;
  real shrink = exp(-half_rise);
  plane = vec2(chord * cos(half_turn) * shrink, -rise - chord * sin(half_turn) * shrink) * (real(2.0) * c * shrink);
  return below_pole && within_angle(params, direction);
}

LENS_FUNCTION bool lambert_conformal_conic_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real n = params.k[2];
  vec2 point = plane / params.k[3];
  real from_apex = real(1.0) + n * point.y;
  real longitude = n == real(0.0) ? point.x : atan(n * point.x, from_apex) / n;
  // ρ² by the horizon's, less 1, over n.
  real excess = real(2.0) * point.y + n * dot(point, point);
  bool off_apex = real(1.0) + n * excess > real(0.0);
  real q = n == real(0.0) || !off_apex ? -point.y : conformal_log1p(n * excess) / (real(-2.0) * n);
  bool below_pole = off_apex && abs(q) < real(14.5);  // asinh 1e6
  direction = normalize(vec3(sin(longitude), below_pole ? -sinh(q) : real(0.0), cos(longitude)));
  return below_pole && abs(longitude) <= lens_pi && within_angle(params, direction);
}
