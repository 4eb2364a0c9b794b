// Central cylindrical panorama: the world seen on an upright cylinder around the camera. Verticals stay straight; rays
// straight up and down never meet the cylinder.
#ifdef __cplusplus
inline constexpr LensInfo cylinder_info = {
    .name = "cylinder",
    .group = "panoramic",
    .also = "cylindrical, central_cylindrical, panorama",
    .formula = "x = longitude, y = tan(latitude)",
    .source = "Snyder 1987, Map Projections, chapter 14 (central cylindrical); Hugin Cylindrical (1)",
    .example = "cylinder:fov_deg=360",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool cylinder_project(Params params, vec3 direction, OUT(vec2) plane) {
  real rho = length(vec2(direction.x, direction.z));
  bool on_cylinder = abs(direction.y) < real(1e6) * rho;
  plane = vec2(longitude_of(direction), on_cylinder ? direction.y / rho : real(0.0));
  return on_cylinder && within_angle(params, direction);
}

LENS_FUNCTION bool cylinder_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  direction = normalize(vec3(sin(plane.x), plane.y, cos(plane.x)));
  return abs(plane.x) <= lens_pi && abs(plane.y) < real(1e6) && within_angle(params, direction);
}
