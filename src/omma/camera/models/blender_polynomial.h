// Blender's FISHEYE_LENS_POLYNOMIAL: the angle as a polynomial of the radius on the sensor in millimetres, and all of
// it negated. It holds as far as that angle rises with the radius.
#ifdef __cplusplus
inline constexpr LensParameterInfo blender_polynomial_parameters[] = {
    {"k0", 0, -0.1, 0.1, "constant term, radians"},
    {"k1", -1, -1e3, 1e3, "coefficient of r, radians mm⁻¹, negative"},
    {"k2", 0, -1e3, 1e3, "coefficient of r², radians mm⁻²"},
    {"k3", 0, -1e3, 1e3, "coefficient of r³, radians mm⁻³"},
    {"k4", 0, -1e3, 1e3, "coefficient of r⁴, radians mm⁻⁴"},
};

inline constexpr LensInfo blender_polynomial_info = {
    .name = "blender_polynomial",
    .group = "radial",
    .also = "fisheye_lens_polynomial",
    .formula = "θ = −(k0 + k1 r + k2 r² + k3 r³ + k4 r⁴), r in mm",
    .source = "Blender 3.4, panoramic camera, Fisheye Lens Polynomial",
    .example =
        "blender_polynomial:sensor_mm=36,max_angle_deg=90,k0=0,k1=-0.019988737,k2=-3.3525323e-06,k3=3.0992753e-06,"
        "k4=-2.6064646e-08",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .plane_in_mm = true,
    .parameters = blender_polynomial_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const auto& k = parameters.k;
          const double c[] = {-k[1], -k[2], -k[3], -k[4]};
          return std::clamp(polynomial_value(c, k[5]) * k[5] - k[0], 0.0, pi);
        },
    // The radius up to which the angle rises.
    .derive =
        [](LensParameters& parameters) {
          auto& k = parameters.k;
          const double c[] = {-k[1], -k[2], -k[3], -k[4]};
          k[5] = polynomial_rise_to(c, pi + k[0]);
        },
};
#else
#include "models/radial_polynomial.h"
#endif

LENS_FUNCTION bool blender_polynomial_project(Params params, vec3 direction, OUT(vec2) plane) {
  real c[8] = {-params.k[1], -params.k[2], -params.k[3], -params.k[4], real(0.0), real(0.0), real(0.0), real(0.0)};
  real theta = angle_from_axis(direction);
  // A negative k0 gives the middle of the image an angle: what lies closer to the axis is drawn there.
  real value = max(theta + params.k[0], real(0.0));
  real r = radial_polynomial_inverse(c, false, value, value / c[0], params.k[5]);
  return radial_project(params, direction, theta, r, plane);
}

LENS_FUNCTION bool blender_polynomial_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real c[8] = {-params.k[1], -params.k[2], -params.k[3], -params.k[4], real(0.0), real(0.0), real(0.0), real(0.0)};
  real r = length(plane);
  real theta = radial_polynomial(c, false, r).x - params.k[0];
  return radial_unproject(params, plane, theta, direction) && theta >= real(0.0) && r <= params.k[5];
}
