// Equirectangular panorama: longitude and latitude as they are, the whole sphere in an image of 2:1.
#ifdef __cplusplus
inline constexpr LensInfo equirectangular_info = {
    .name = "equirectangular",
    .group = "panoramic",
    .also = "equirect, latlong, plate_carree, spherical",
    .formula = "x = longitude, y = latitude",
    .source = "Snyder 1987, Map Projections, chapter 12; COLMAP EQUIRECTANGULAR",
    .example = "equirectangular:fov_deg=360,width=1600,height=800",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
};
#endif

LENS_FUNCTION bool equirectangular_project(Params params, vec3 direction, OUT(vec2) plane) {
  real latitude = atan(direction.y, length(vec2(direction.x, direction.z)));
  plane = vec2(longitude_of(direction), latitude);
  return angle_from_axis(direction) <= params.max_angle;
}

LENS_FUNCTION bool equirectangular_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  direction = vec3(sin(plane.x) * cos(plane.y), sin(plane.y), cos(plane.x) * cos(plane.y));
  return abs(plane.x) <= lens_pi && abs(plane.y) <= real(0.5) * lens_pi &&
         angle_from_axis(direction) <= params.max_angle;
}
