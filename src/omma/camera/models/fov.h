// The field-of-view lens of Devernay and Faugeras: an ideal fisheye of one coefficient, as COLMAP (FOV), Basalt (fov),
// Kalibr (pinhole-fov) and PTAM calibrate it.
#ifdef __cplusplus
inline constexpr LensParameterInfo fov_parameters[] = {
    {"omega", 1, 0.001, 3.14, "field of view of the ideal lens, radians; Basalt's w"},
};

inline constexpr LensInfo fov_info = {
    .name = "fov",
    .group = "calibrated",
    .also = "pinhole-fov, devernay, atan",
    .formula = "r = atan(2 tan(ω/2) tan θ) / ω",
    .source = "Devernay, Faugeras 2001, Straight lines have to be straight, section 3; COLMAP FOV",
    .example = "fov:fx=250,fy=251,cx=320.5,cy=240.25,width=640,height=480,omega=0.92",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = fov_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool fov_project(Params params, vec3 direction, OUT(vec2) plane) {
  real omega = params.k[0];
  real rho = length(vec2(direction.x, direction.y));
  real r = atan(real(2.0) * tan(real(0.5) * omega) * rho, direction.z) / omega;
  return radial_project(params, direction, angle_from_axis(direction), r, plane);
}

LENS_FUNCTION bool fov_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real omega = params.k[0];
  real turn = length(plane) * omega;
  real theta = atan(sin(turn), real(2.0) * tan(real(0.5) * omega) * cos(turn));
  return radial_unproject(params, plane, theta, direction) && turn <= lens_pi;
}
