// Kannala-Brandt fisheye with four coefficients, as OpenCV's fisheye module, Kalibr (`equidistant`), ROS and COLMAP
// (OPENCV_FISHEYE) calibrate it: the radius is an odd polynomial of the angle. It holds as far as that polynomial
// rises. OpenCV and Kalibr put the centre of the first pixel at (0, 0): their cx and cy need 0.5 added.
#ifdef __cplusplus
inline constexpr LensParameterInfo opencv_fisheye_parameters[] = {
    {"k1", 0, -10, 10, "coefficient of θ³, radians⁻²"},
    {"k2", 0, -10, 10, "coefficient of θ⁵, radians⁻⁴"},
    {"k3", 0, -10, 10, "coefficient of θ⁷, radians⁻⁶"},
    {"k4", 0, -10, 10, "coefficient of θ⁹, radians⁻⁸"},
};

inline constexpr LensInfo opencv_fisheye_info = {
    .name = "opencv_fisheye",
    .group = "calibrated",
    .also = "kannala_brandt, kannala_brandt8, kb4, pinhole-equi, simple_radial_fisheye, radial_fisheye",
    .formula = "r = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)",
    .source = "Kannala, Brandt 2006; OpenCV 4.6 fisheye module",
    .example =
        "opencv_fisheye:f=190.97,cx=255.4,cy=257.4,width=512,height=512,"
        "k1=0.0035,k2=0.0007,k3=-0.0021,k4=0.0002",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .parameters = opencv_fisheye_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const auto& k = parameters.k;
          // dr/dθ as a polynomial of θ²; where it first vanishes the radius turns back.
          const double slope[] = {1.0, 3 * k[0], 5 * k[1], 7 * k[2], 9 * k[3]};
          const std::vector<double> turns = polynomial_roots(slope, 0.0, pi * pi);
          return turns.empty() ? pi : std::sqrt(turns.front());
        },
};
#endif
#ifndef __cplusplus
#include "models/radial_polynomial.h"
#endif

LENS_FUNCTION real opencv_fisheye_radius(Params params, real theta) {
  real t2 = theta * theta;
  return theta * (real(1.0) + t2 * (params.k[0] + t2 * (params.k[1] + t2 * (params.k[2] + t2 * params.k[3]))));
}

LENS_FUNCTION bool opencv_fisheye_project(Params params, vec3 direction, OUT(vec2) plane) {
  real theta = angle_from_axis(direction);
  return radial_project(params, direction, theta, opencv_fisheye_radius(params, theta), plane);
}

LENS_FUNCTION bool opencv_fisheye_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real r = length(plane);
  real c[8] = {real(1.0), params.k[0], params.k[1], params.k[2], params.k[3], real(0.0), real(0.0), real(0.0)};
  real theta = radial_polynomial_inverse(c, true, r, r, params.max_angle);
  return radial_unproject(params, plane, theta, direction) && r <= opencv_fisheye_radius(params, params.max_angle);
}
