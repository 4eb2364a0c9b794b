// A pinhole with the distortion of Brown and Conrady as OpenCV calibrates it, with up to fourteen coefficients: radial,
// tangential, rational, thin prism, tilted sensor. ROS (plumb_bob, rational_polynomial), Kalibr (pinhole-radtan) and
// COLMAP (SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV) use the first four, five or eight. It holds as far as the radial
// part rises. OpenCV, ROS and Kalibr put the centre of the first pixel at (0, 0): their cx and cy need 0.5 added.
#ifndef __cplusplus
#include "models/distortion.h"
#endif

LENS_FUNCTION Distortion opencv_distortion(Params params) {
  Distortion d;
  for (int i = 0; i < 6; ++i) d.numerator[i] = real(0.0);
  d.numerator[0] = params.k[0];
  d.numerator[1] = params.k[1];
  d.numerator[2] = params.k[4];
  for (int i = 0; i < 3; ++i) d.denominator[i] = params.k[5 + i];
  d.tangential = vec2(params.k[2], params.k[3]);
  d.prism = vec4(params.k[8], params.k[9], params.k[10], params.k[11]);
  return d;
}

#ifdef __cplusplus
inline constexpr LensParameterInfo opencv_parameters[] = {
    {"k1", 0, -1e6, 1e6, "radial, of r²; the k of SIMPLE_RADIAL"},
    {"k2", 0, -1e6, 1e6, "radial, of r⁴"},
    {"p1", 0, -10, 10, "tangential, with r² + 2 y²"},
    {"p2", 0, -10, 10, "tangential, with r² + 2 x²"},
    {"k3", 0, -1e6, 1e6, "radial, of r⁶"},
    {"k4", 0, -1e6, 1e6, "radial in the denominator, of r²"},
    {"k5", 0, -1e6, 1e6, "radial in the denominator, of r⁴"},
    {"k6", 0, -1e6, 1e6, "radial in the denominator, of r⁶"},
    {"s1", 0, -10, 10, "thin prism on x, of r²"},
    {"s2", 0, -10, 10, "thin prism on x, of r⁴"},
    {"s3", 0, -10, 10, "thin prism on y, of r²"},
    {"s4", 0, -10, 10, "thin prism on y, of r⁴"},
    {"tau_x", 0, -1.2, 1.2, "tilt of the sensor about x, radians"},
    {"tau_y", 0, -1.2, 1.2, "tilt of the sensor about y, radians"},
};

inline constexpr LensInfo opencv_info = {
    .name = "opencv",
    .group = "calibrated",
    .also = "full_opencv, simple_radial, radial, brown_conrady, radtan, pinhole-radtan, plumb_bob, rational_polynomial",
    .formula = "r' = r (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶), r = tan θ; and p1, p2, s1…s4, tilt",
    .source = "Brown 1966; Conrady 1919; OpenCV 4.6 calib3d, projectPoints",
    .example =
        "opencv:fx=458.654,fy=457.296,cx=367.715,cy=248.875,width=752,height=480,"
        "k1=-0.28340811,k2=0.07395907,p1=0.00019359,p2=0.0000176187,k3=0.002,k4=0.01,k5=0.003,k6=0.0005,"
        "s1=0.0007,s2=-0.0002,s3=-0.0004,s4=0.0001,tau_x=0.02,tau_y=-0.03",
    .default_fov_deg = 0,
    .max_fov_deg = 180,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = true,
    .skewed = true,
    .parameters = opencv_parameters,
    .max_angle = [](const LensParameters& parameters) { return std::atan(parameters.k[14]); },
    // The radius before distortion up to which the one after it rises and is no other's.
    .derive =
        [](LensParameters& parameters) {
          auto& k = parameters.k;
          const double top[] = {1.0, k[0], k[1], k[4]}, bottom[] = {1.0, k[5], k[6], k[7]};
          k[14] = invertible_radius(opencv_distortion(parameters), rational_rise(top, bottom));
        },
};
#endif

// What the lens forms on the plane z = 1, as the tilted sensor has it: the product of OpenCV's tilt matrix, multiplied
// out.
LENS_FUNCTION bool opencv_tilt(Params params, vec2 u, OUT(vec2) tilted) {
  vec2 c = vec2(cos(params.k[12]), cos(params.k[13]));
  vec2 s = vec2(sin(params.k[12]), sin(params.k[13]));
  real w = s.y * u.x - c.y * s.x * u.y + c.x * c.y;
  tilted = vec2(c.x * u.x, c.y * u.y - s.x * s.y * u.x) / w;
  return w > real(0.0);
}

LENS_FUNCTION bool opencv_untilt(Params params, vec2 tilted, OUT(vec2) u) {
  vec2 c = vec2(cos(params.k[12]), cos(params.k[13]));
  vec2 s = vec2(sin(params.k[12]), sin(params.k[13]));
  real x = tilted.x / c.x;
  real y = (tilted.y + s.x * s.y * x) / c.y;
  real w = (real(1.0) - s.y * x + c.y * s.x * y) / (c.x * c.y);
  u = vec2(x, y) / w;
  return w > real(0.0) && length(tilted) < real(1e8);  // what is infinitely far has a ray, but no point
}

LENS_FUNCTION bool opencv_project(Params params, vec3 direction, OUT(vec2) plane) {
  plane = vec2(real(0.0));
  if (!(direction.z > real(0.0)) || angle_from_axis(direction) > params.max_angle) return false;
  vec2 distorted;
  vec4 slope;
  distort(opencv_distortion(params), vec2(direction.x, direction.y) / direction.z, distorted, slope);
  return opencv_tilt(params, distorted, plane);
}

LENS_FUNCTION bool opencv_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  vec2 distorted;
  vec2 u = vec2(real(0.0));
  bool valid = opencv_untilt(params, plane, distorted);
  valid = undistort(opencv_distortion(params), distorted, params.k[14], u) && valid;
  direction = normalize(vec3(u.x, u.y, real(1.0)));
  return valid && angle_from_axis(direction) <= params.max_angle;
}
