// Equisolid-angle fisheye, Lambert's azimuthal equal-area projection: equal solid angles get equal areas of the image.
// At 360 degrees it is what a mirror ball shows, or ffmpeg's `ball` (a photograph of a real ball is also mirrored).
#ifdef __cplusplus
inline constexpr LensPreset equisolid_presets[] = {
    {"mirror_ball", "fov_deg=360"},
    {"mirrorball", "fov_deg=360"},
    {"ball", "fov_deg=360"},
};

inline constexpr LensInfo equisolid_info = {
    .name = "equisolid",
    .group = "radial",
    .also = "equal_area_fisheye, lambert_azimuthal, fisheye_equisolid",
    .formula = "r = 2 sin(θ/2)",
    .source = "Lambert 1772; Snyder 1987, Map Projections, chapter 24",
    .example = "equisolid:fov_deg=180",
    .default_fov_deg = 180,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
    .presets = equisolid_presets,
};
#endif

LENS_FUNCTION bool equisolid_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, real(2.0) * sin(real(0.5) * theta), plane);
}

LENS_FUNCTION bool equisolid_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real sine = real(0.5) * length(plane);
  real cosine = sqrt(max(real(0.0), (real(1.0) - sine) * (real(1.0) + sine)));
  real theta = real(2.0) * atan(sine, cosine);
  return radial_unproject(params, plane, theta, direction) && sine <= real(1.0);
}
