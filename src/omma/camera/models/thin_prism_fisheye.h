// COLMAP's THIN_PRISM_FISHEYE: an equidistant fisheye, then OpenCV's distortion on its plane. It holds as far as the
// radial part rises.
#ifndef __cplusplus
#include "models/distortion.h"
#endif

LENS_FUNCTION Distortion thin_prism_fisheye_distortion(Params params) {
  Distortion d;
  for (int i = 0; i < 6; ++i) d.numerator[i] = real(0.0);
  for (int i = 0; i < 3; ++i) d.denominator[i] = real(0.0);
  d.numerator[0] = params.k[0];
  d.numerator[1] = params.k[1];
  d.numerator[2] = params.k[4];
  d.numerator[3] = params.k[5];
  d.tangential = vec2(params.k[2], params.k[3]);
  d.prism = vec4(params.k[6], real(0.0), params.k[7], real(0.0));
  return d;
}

#ifdef __cplusplus
inline constexpr LensParameterInfo thin_prism_fisheye_parameters[] = {
    {"k1", 0, -10, 10, "radial, of θ²"},
    {"k2", 0, -10, 10, "radial, of θ⁴"},
    {"p1", 0, -10, 10, "tangential, with θ² + 2 y²"},
    {"p2", 0, -10, 10, "tangential, with θ² + 2 x²"},
    {"k3", 0, -10, 10, "radial, of θ⁶"},
    {"k4", 0, -10, 10, "radial, of θ⁸"},
    {"sx1", 0, -10, 10, "thin prism on x, of θ²"},
    {"sy1", 0, -10, 10, "thin prism on y, of θ²"},
};

inline constexpr LensInfo thin_prism_fisheye_info = {
    .name = "thin_prism_fisheye",
    .group = "calibrated",
    .also = "thin_prism",
    .formula = "r = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸); and p1, p2, sx1, sy1",
    .source = "COLMAP THIN_PRISM_FISHEYE; Weng, Cohen, Herniou 1992 (thin prism)",
    .example =
        "thin_prism_fisheye:fx=651.1,fy=652.3,cx=400.5,cy=300.25,width=800,height=600,"
        "k1=-0.21,k2=0.21,p1=-0.0003,p2=0.0004,k3=-0.16,k4=0.06,sx1=0.0005,sy1=-0.0007",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .skewed = true,
    .parameters = thin_prism_fisheye_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const auto& k = parameters.k;
          const double top[] = {1.0, k[0], k[1], k[4], k[5]}, bottom[] = {1.0};
          return invertible_radius(thin_prism_fisheye_distortion(parameters), std::min(pi, rational_rise(top, bottom)));
        },
};
#endif

LENS_FUNCTION bool thin_prism_fisheye_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  vec2 u;
  bool valid = radial_project(params, direction, theta, theta, u);
  vec4 slope;
  distort(thin_prism_fisheye_distortion(params), u, plane, slope);
  return valid;
}

LENS_FUNCTION bool thin_prism_fisheye_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  vec2 u;
  bool valid = undistort(thin_prism_fisheye_distortion(params), plane, params.max_angle, u);
  return radial_unproject(params, u, length(u), direction) && valid;
}
