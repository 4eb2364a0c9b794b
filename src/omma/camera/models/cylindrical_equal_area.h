// Cylindrical equal-area projection, Lambert's, and with another standard parallel Behrmann's, Hobo-Dyer's or
// Gall-Peters': equal solid angles get equal areas of the image, shapes are true at the standard parallel.
#ifdef __cplusplus
inline constexpr LensParameterInfo cylindrical_equal_area_parameters[] = {
    {"parallel_deg", 0, 0, 85, "standard parallel, degrees of latitude"},
};
inline constexpr LensPreset cylindrical_equal_area_presets[] = {
    {"behrmann", "parallel_deg=30"},
    {"hobo_dyer", "parallel_deg=37.5"},
    {"gall_peters", "parallel_deg=45"},
};

inline constexpr LensInfo cylindrical_equal_area_info = {
    .name = "cylindrical_equal_area",
    .group = "panoramic",
    .also = "cylindricalea, lambert_cylindrical, lambert_equal_area",
    .formula = "x = longitude · cos(parallel), y = sin(latitude) / cos(parallel)",
    .source = "Lambert 1772; Snyder 1987, Map Projections, chapter 10; Hugin Lambert equal area (8)",
    .example = "cylindrical_equal_area:fov_deg=360,parallel_deg=20",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = cylindrical_equal_area_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
    .presets = cylindrical_equal_area_presets,
};
#endif

LENS_FUNCTION bool cylindrical_equal_area_project(Params params, vec3 direction, OUT(vec2) plane) {
  real width = cos(radians(params.k[0]));
  plane = vec2(longitude_of(direction) * width, direction.y / (length(direction) * width));
  return within_angle(params, direction);
}

LENS_FUNCTION bool cylindrical_equal_area_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real width = cos(radians(params.k[0]));
  real longitude = plane.x / width;
  real sine = plane.y * width;
  real cosine = sqrt(max(real(0.0), (real(1.0) - sine) * (real(1.0) + sine)));
  direction = vec3(sin(longitude) * cosine, sine, cos(longitude) * cosine);
  return abs(longitude) <= lens_pi && abs(sine) <= real(1.0) && within_angle(params, direction);
}
