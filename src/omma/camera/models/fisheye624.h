// Six radial coefficients, two tangential, four thin prism: Project Aria's FISHEYE624, nerfstudio's, COLMAP's
// RAD_TAN_THIN_PRISM_FISHEYE, Omniverse's radTanThinPrism. Unlike elsewhere the radial part comes first and the rest is
// worked out from its result, and p0 stands where OpenCV has p2. It holds as far as the radial part rises.
#ifndef __cplusplus
#include "models/distortion.h"
#include "models/radial_polynomial.h"
#endif

// What follows the radial part.
LENS_FUNCTION Distortion fisheye624_distortion(Params params) {
  Distortion d;
  for (int i = 0; i < 6; ++i) d.numerator[i] = real(0.0);
  for (int i = 0; i < 3; ++i) d.denominator[i] = real(0.0);
  d.tangential = vec2(params.k[7], params.k[6]);
  d.prism = vec4(params.k[8], params.k[9], params.k[10], params.k[11]);
  return d;
}

#ifdef __cplusplus
inline constexpr LensParameterInfo fisheye624_parameters[] = {
    {"k0", 0, -10, 10, "radial, of θ²"},
    {"k1", 0, -10, 10, "radial, of θ⁴"},
    {"k2", 0, -10, 10, "radial, of θ⁶"},
    {"k3", 0, -10, 10, "radial, of θ⁸"},
    {"k4", 0, -10, 10, "radial, of θ¹⁰"},
    {"k5", 0, -10, 10, "radial, of θ¹²"},
    {"p0", 0, -10, 10, "tangential, with r² + 2 x²"},
    {"p1", 0, -10, 10, "tangential, with r² + 2 y²"},
    {"s0", 0, -10, 10, "thin prism on x, of r²"},
    {"s1", 0, -10, 10, "thin prism on x, of r⁴"},
    {"s2", 0, -10, 10, "thin prism on y, of r²"},
    {"s3", 0, -10, 10, "thin prism on y, of r⁴"},
};

inline constexpr LensInfo fisheye624_info = {
    .name = "fisheye624",
    .group = "calibrated",
    .also = "rad_tan_thin_prism_fisheye, radtanthinprism",
    .formula = "r = θ (1 + k0 θ² + k1 θ⁴ + … + k5 θ¹²); and p0, p1, s0…s3",
    .source =
        "Project Aria, camera intrinsic models (Fisheye62, FisheyeRadTanThinPrism); COLMAP RAD_TAN_THIN_PRISM_FISHEYE",
    .example =
        "fisheye624:f=608,cx=714.25,cy=704.5,width=1408,height=1408,"
        "k0=0.4,k1=-0.48,k2=0.11,k3=0.09,k4=-0.05,k5=0.0073,p0=-0.0005,p1=0.0003,"
        "s0=0.0006,s1=-0.00022,s2=0.0004,s3=-0.00014",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .skewed = true,
    .parameters = fisheye624_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const auto& k = parameters.k;
          const double radial[] = {1.0, 0.0, k[0], 0.0, k[1], 0.0, k[2], 0.0, k[3], 0.0, k[4], 0.0, k[5]};
          return std::min(pi, polynomial_rise_to(radial, k[12]));
        },
    // The radius up to which the radial part rises and what follows it gives no point twice.
    .derive =
        [](LensParameters& parameters) {
          auto& k = parameters.k;
          const double radial[] = {1.0, 0.0, k[0], 0.0, k[1], 0.0, k[2], 0.0, k[3], 0.0, k[4], 0.0, k[5]};
          const double theta = polynomial_rise(radial, pi);
          k[12] = invertible_radius(fisheye624_distortion(parameters), theta * polynomial_value(radial, theta));
        },
};
#endif

LENS_FUNCTION bool fisheye624_project(Params params, vec3 direction, OUT(vec2) plane) {
  real c[8] = {real(1.0), params.k[0], params.k[1], params.k[2], params.k[3], params.k[4], params.k[5], real(0.0)};
  real theta = angle_from_axis(direction);
  vec2 u;
  bool valid = radial_project(params, direction, theta, radial_polynomial(c, true, theta).x, u);
  vec4 slope;
  distort(fisheye624_distortion(params), u, plane, slope);
  return valid;
}

LENS_FUNCTION bool fisheye624_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real c[8] = {real(1.0), params.k[0], params.k[1], params.k[2], params.k[3], params.k[4], params.k[5], real(0.0)};
  vec2 u;
  bool valid = undistort(fisheye624_distortion(params), plane, params.k[12], u);
  real r = length(u);
  real theta = radial_polynomial_inverse(c, true, r, r, params.max_angle);
  return radial_unproject(params, u, theta, direction) && valid && r <= radial_polynomial(c, true, params.max_angle).x;
}
