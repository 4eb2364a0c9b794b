// The pinhole: straight lines stay straight. Divides by z instead of taking tan θ, which is exact to the last digit.
#ifdef __cplusplus
inline constexpr LensInfo perspective_info = {
    .name = "perspective",
    .group = "radial",
    .also = "pinhole, simple_pinhole, rectilinear, flat, gnomonic",
    .formula = "r = tan θ",
    .source = "OpenGL 4.5, 13.6 (gluPerspective); COLMAP PINHOLE",
    .example = "perspective:fov_deg=90",
    .default_fov_deg = 90,
    .max_fov_deg = 180,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = true,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi / 2 - open_end; },
};
#endif

LENS_FUNCTION bool perspective_project(Params params, vec3 direction, OUT(vec2) plane) {
  bool ahead = direction.z > real(0.0);
  plane = ahead ? vec2(direction.x, direction.y) / direction.z : vec2(real(0.0));
  return ahead && angle_from_axis(direction) <= params.max_angle;
}

LENS_FUNCTION bool perspective_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  direction = normalize(vec3(plane.x, plane.y, real(1.0)));
  return atan(length(plane), real(1.0)) <= params.max_angle;
}
