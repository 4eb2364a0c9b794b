// The double sphere: Basalt's and Kalibr's ds. Two unit spheres, xi apart, then a pinhole. It holds up to the angle at
// which its radius is infinite (alpha up to a half) or turns back.
#ifdef __cplusplus
inline constexpr LensParameterInfo double_sphere_parameters[] = {
    {"xi", 0, -0.99, 1, "distance of the spheres' centres"},
    {"alpha", 0.5, 0, 1, "how far the pinhole lies from the second centre: alpha / (1 - alpha)"},
};

inline constexpr LensInfo double_sphere_info = {
    .name = "double_sphere",
    .group = "calibrated",
    .also = "ds, ds-none",
    .formula = "r = ρ / (α √(ρ² + (ξ + z)²) + (1 − α) (ξ + z)), ρ = sin θ, z = cos θ",
    .source = "Usenko, Demmel, Cremers 2018, The double sphere camera model",
    .example =
        "double_sphere:fx=158.28600034966977,fy=158.2743455478755,cx=255.46116578191653,cy=257.3894394501779,"
        "width=512,height=512,xi=-0.17213086034353243,alpha=0.5931177593944744",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = double_sphere_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double xi = parameters.k[0], alpha = parameters.k[1];
          const double w = alpha <= 0.5 ? alpha / (1 - alpha) : (1 - alpha) / alpha;
          const double cosine = -(w + xi) / std::sqrt(2 * w * xi + xi * xi + 1);
          const double limit = std::acos(std::clamp(cosine, -1.0, 1.0));
          return alpha <= 0.5 ? limit - open_end : limit;
        },
};
#endif

LENS_FUNCTION bool double_sphere_project(Params params, vec3 direction, OUT(vec2) plane) {
  real alpha = params.k[1];
  vec2 across = vec2(direction.x, direction.y);
  real s = dot(across, across);
  real z = params.k[0] * length(direction) + direction.z;
  real far = alpha * sqrt(s + z * z);
  real near = (real(1.0) - alpha) * z;
  // Behind, far + near would lose most digits.
  real scale =
      near > real(0.0) ? far + near : (alpha * alpha * s + (real(2.0) * alpha - real(1.0)) * z * z) / (far - near);
  bool valid = angle_from_axis(direction) <= params.max_angle && scale > real(0.0);
  plane = valid ? across / scale : vec2(real(0.0));
  return valid;
}

LENS_FUNCTION bool double_sphere_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real xi = params.k[0];
  real alpha = params.k[1];
  real s = dot(plane, plane);
  real inner = real(1.0) - (real(2.0) * alpha - real(1.0)) * s;
  // From the second sphere's centre, then from the first.
  real z = (real(1.0) - alpha * alpha * s) / (alpha * sqrt(max(inner, real(0.0))) + real(1.0) - alpha);
  real ray = (z * xi + sqrt(max(z * z + (real(1.0) - xi * xi) * s, real(0.0)))) / (z * z + s);
  direction = normalize(vec3(plane.x * ray, plane.y * ray, z * ray - xi));
  return inner >= real(0.0) && angle_from_axis(direction) <= params.max_angle;
}
