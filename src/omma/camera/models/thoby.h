// Thoby fisheye: what Michel Thoby measured on the AF DX 10.5 mm, as Hugin and panotools offer it.
#ifdef __cplusplus
inline constexpr LensParameterInfo thoby_parameters[] = {
    {"k1", 1.47, 0.01, 100, "factor of the sine"},
    {"k2", 0.713, 0.01, 100, "factor of the angle"},
};

inline constexpr LensInfo thoby_info = {
    .name = "thoby",
    .group = "radial",
    .also = "fisheye_thoby",
    .formula = "r = k1 sin(k2 θ)",
    .source = "Thoby 2012, About the various projections of the photographic objective lenses; panotools",
    .example = "thoby:fov_deg=180,k1=1.47,k2=0.713",
    .default_fov_deg = 180,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = thoby_parameters,
    .max_angle = [](const LensParameters& parameters) { return std::min(pi, pi / 2 / parameters.k[1]); },
};
#endif

LENS_FUNCTION bool thoby_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, params.k[0] * sin(params.k[1] * theta), plane);
}

LENS_FUNCTION bool thoby_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real sine = length(plane) / params.k[0];
  real cosine = sqrt(max(real(0.0), (real(1.0) - sine) * (real(1.0) + sine)));
  real theta = atan(sine, cosine) / params.k[1];
  return radial_unproject(params, plane, theta, direction) && sine <= real(1.0);
}
