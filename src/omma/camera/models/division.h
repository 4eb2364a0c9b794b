// The division model of one coefficient: COLMAP's SIMPLE_DIVISION and DIVISION. A negative k sees beyond 180 degrees;
// with a positive one the radius turns back.
#ifdef __cplusplus
inline constexpr LensParameterInfo division_parameters[] = {
    {"k", 0, -1e6, 1e6, "coefficient of r²"},
};

inline constexpr LensInfo division_info = {
    .name = "division",
    .group = "calibrated",
    .also = "simple_division, fitzgibbon",
    .formula = "tan θ = r / (1 + k r²)",
    .source =
        "Fitzgibbon 2001, Simultaneous linear estimation of multiple view geometry and lens distortion; COLMAP "
        "DIVISION",
    .example = "division:fx=300,fy=301,cx=320.5,cy=240.25,width=640,height=480,k=-0.21",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = true,
    .parameters = division_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double k = parameters.k[0];
          return k > 0.0 ? std::atan(0.5 / std::sqrt(k)) : (k < 0.0 ? pi : pi / 2) - open_end;
        },
};
#endif

LENS_FUNCTION bool division_project(Params params, vec3 direction, OUT(vec2) plane) {
  // k ρ r² − z r + ρ = 0, its smaller root; each way of writing it loses digits for the other sign of z.
  real rho = length(vec2(direction.x, direction.y));
  real z = direction.z;
  real root = sqrt(max(z * z - real(4.0) * params.k[0] * rho * rho, real(0.0)));
  real r = z > real(0.0) ? real(2.0) * rho / (z + root) : (z - root) / (real(2.0) * params.k[0] * rho);
  bool valid = angle_from_axis(direction) <= params.max_angle;
  radial_project(params, direction, real(0.0), valid ? r : real(0.0), plane);
  return valid;
}

LENS_FUNCTION bool division_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real s = dot(plane, plane);
  direction = normalize(vec3(plane.x, plane.y, real(1.0) + params.k[0] * s));
  return params.k[0] * s <= real(1.0) && angle_from_axis(direction) <= params.max_angle;
}
