// The image radius as a polynomial of the angle, in all powers: WoodScape's four coefficients, and what lens makers and
// other simulators publish. It holds as far as the polynomial rises. The coefficients carry the unit of the radius:
// those of WoodScape are pixels, to be taken with f=1.
#ifdef __cplusplus
inline constexpr LensParameterInfo polynomial_parameters[] = {
    {"k1", 1, -1e9, 1e9, "coefficient of θ, positive"}, {"k2", 0, -1e9, 1e9, "coefficient of θ²"},
    {"k3", 0, -1e9, 1e9, "coefficient of θ³"},          {"k4", 0, -1e9, 1e9, "coefficient of θ⁴"},
    {"k5", 0, -1e9, 1e9, "coefficient of θ⁵"},          {"k6", 0, -1e9, 1e9, "coefficient of θ⁶"},
    {"k7", 0, -1e9, 1e9, "coefficient of θ⁷"},          {"k8", 0, -1e9, 1e9, "coefficient of θ⁸"},
};

inline constexpr LensInfo polynomial_info = {
    .name = "polynomial",
    .group = "radial",
    .also = "radial_poly, woodscape, polynomial_fisheye",
    .formula = "r = k1 θ + k2 θ² + … + k8 θ⁸",
    .source = "Yogamani et al. 2019, WoodScape (four coefficients)",
    .example =
        "polynomial:f=1,cx=643.942,cy=479.907,width=1280,height=966,"
        "k1=339.749,k2=-31.988,k3=48.275,k4=-7.201,k5=0,k6=0,k7=0,k8=0",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = polynomial_parameters,
    .max_angle = [](const LensParameters& parameters) { return polynomial_rise(std::span(parameters.k).first(8), pi); },
};
#else
#include "models/radial_polynomial.h"
#endif

LENS_FUNCTION real polynomial_radius(Params params, real theta) {
  real r = real(0.0);
  for (int i = 7; i >= 0; --i) r = (r + params.k[i]) * theta;
  return r;
}

LENS_FUNCTION bool polynomial_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, polynomial_radius(params, theta), plane);
}

LENS_FUNCTION bool polynomial_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real c[8] = {params.k[0], params.k[1], params.k[2], params.k[3], params.k[4], params.k[5], params.k[6], params.k[7]};
  real r = length(plane);
  real theta = radial_polynomial_inverse(c, false, r, r / params.k[0], params.max_angle);
  return radial_unproject(params, plane, theta, direction) && r <= polynomial_radius(params, params.max_angle);
}
