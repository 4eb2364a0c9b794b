// The custom lens of SDF and Gazebo: one of three functions, scaled and shifted. SDF's own f is the focal length of the
// camera. A shift c3 that makes the radius of the axis positive leaves a hole in the middle of the image; one that
// makes it negative, a cone around the axis that is not seen.
#ifdef __cplusplus
inline constexpr LensParameterInfo custom_radial_parameters[] = {
    {"c1", 1, 1e-6, 1e6, "factor of the radius"},
    {"c2", 1, 1e-3, 1e3, "divisor of the angle"},
    {"c3", 0, -1.5, 1.5, "radians added to the divided angle"},
    {"fun", 0, 0, 2, "the function", "tan, sin, id"},
};

inline constexpr LensInfo custom_radial_info = {
    .name = "custom_radial",
    .group = "radial",
    .also = "custom, gazebo_custom, sdf_custom",
    .formula = "r = c1 fun(θ/c2 + c3)",
    .source = "SDFormat 1.6, lens/custom_function",
    .example = "custom_radial:fov_deg=200,c1=1.05,c2=4,c3=0,fun=tan",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = custom_radial_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const auto& k = parameters.k;
          if (k[3] == 2.0) return pi;
          return std::min(pi, k[1] * (pi / 2 - k[2]) - (k[3] == 0.0 ? open_end : 0.0));
        },
};
#endif

LENS_FUNCTION bool custom_radial_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  real inner = theta / params.k[1] + params.k[2];
  real value = params.k[3] == real(0.0) ? tan(inner) : params.k[3] == real(1.0) ? sin(inner) : inner;
  return radial_project(params, direction, theta, params.k[0] * value, plane) && inner >= real(0.0);
}

LENS_FUNCTION bool custom_radial_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real value = length(plane) / params.k[0];
  bool is_sine = params.k[3] == real(1.0);
  real cosine = sqrt(max(real(0.0), (real(1.0) - value) * (real(1.0) + value)));
  real inner = params.k[3] == real(0.0) ? atan(value, real(1.0)) : is_sine ? atan(value, cosine) : value;
  real theta = (inner - params.k[2]) * params.k[1];
  bool within = theta >= real(0.0) && !(is_sine && value > real(1.0));
  return radial_unproject(params, plane, theta, direction) && within;
}
