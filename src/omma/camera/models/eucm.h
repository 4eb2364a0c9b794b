// The enhanced unified camera model, and with beta 1 the unified one in the form of one coefficient between 0 and 1:
// Basalt's ucm and eucm, Kalibr's eucm, COLMAP's EUCM. It holds up to the angle at which its radius is infinite (alpha
// up to a half) or turns back.
#ifdef __cplusplus
inline constexpr LensParameterInfo eucm_parameters[] = {
    {"alpha", 0.5, 0, 1, "how far from the plane: 0 pinhole, 0.5 stereographic with beta 1"},
    {"beta", 1, 1e-3, 1e3, "scale of the ellipsoid across the axis; 1 is the sphere of ucm"},
};

inline constexpr LensInfo eucm_info = {
    .name = "eucm",
    .group = "calibrated",
    .also = "ucm, eucm-none",
    .formula = "r = ρ / (α √(β ρ² + z²) + (1 − α) z), ρ = sin θ, z = cos θ",
    .source = "Khomutenko, Garcia, Martinet 2016, An enhanced unified camera model",
    .example =
        "eucm:fx=191.14799836282189,fy=191.13150963902818,cx=255.4585771534443,cy=257.38154645599448,"
        "width=512,height=512,alpha=0.6291060881178562,beta=1.0418067381860868",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = eucm_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double alpha = parameters.k[0], beta = parameters.k[1];
          // z > −w √(β ρ² + z²)
          const double w = alpha <= 0.5 ? alpha / (1 - alpha) : (1 - alpha) / alpha;
          const double limit = std::atan2(std::sqrt((1 - w) * (1 + w)), -w * std::sqrt(beta));
          return alpha <= 0.5 ? limit - open_end : limit;
        },
};
#endif

LENS_FUNCTION bool eucm_project(Params params, vec3 direction, OUT(vec2) plane) {
  real alpha = params.k[0];
  vec2 across = vec2(direction.x, direction.y);
  real s = params.k[1] * dot(across, across);
  real far = alpha * sqrt(s + direction.z * direction.z);
  real near = (real(1.0) - alpha) * direction.z;
  // Behind, far + near would lose most digits.
  real scale = near > real(0.0)
                   ? far + near
                   : (alpha * alpha * s + (real(2.0) * alpha - real(1.0)) * direction.z * direction.z) / (far - near);
  bool valid = angle_from_axis(direction) <= params.max_angle && scale > real(0.0);
  plane = valid ? across / scale : vec2(real(0.0));
  return valid;
}

LENS_FUNCTION bool eucm_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real alpha = params.k[0];
  real s = params.k[1] * dot(plane, plane);
  real inner = real(1.0) - (real(2.0) * alpha - real(1.0)) * s;
  real z = (real(1.0) - alpha * alpha * s) / (alpha * sqrt(max(inner, real(0.0))) + real(1.0) - alpha);
  direction = normalize(vec3(plane.x, plane.y, z));
  return inner >= real(0.0) && angle_from_axis(direction) <= params.max_angle;
}
