// The unified model of Mei with radial and tangential distortion: OpenCV's omnidir, camodocal's MEI, KITTI-360's
// fisheyes, Kalibr's omni. The distortion is that of OpenCV's pinhole, on the plane of the unified model. It holds up
// to the angle at which a radius is infinite or turns back. OpenCV and camodocal put the centre of the first pixel at
// (0, 0): their cx and cy need 0.5 added.
#ifndef __cplusplus
#include "models/distortion.h"
#endif

LENS_FUNCTION Distortion mei_distortion(Params params) {
  Distortion d;
  for (int i = 0; i < 6; ++i) d.numerator[i] = real(0.0);
  for (int i = 0; i < 3; ++i) d.denominator[i] = real(0.0);
  d.numerator[0] = params.k[1];
  d.numerator[1] = params.k[2];
  d.tangential = vec2(params.k[3], params.k[4]);
  d.prism = vec4(real(0.0));
  return d;
}

#ifdef __cplusplus
inline constexpr LensParameterInfo mei_parameters[] = {
    {"xi", 1, 0, 1e3, "distance of the sphere's centre from the pinhole: 0 pinhole, 1 paraboloid"},
    {"k1", 0, -1e6, 1e6, "radial, of r²"},
    {"k2", 0, -1e6, 1e6, "radial, of r⁴"},
    {"p1", 0, -10, 10, "tangential, with r² + 2 y²"},
    {"p2", 0, -10, 10, "tangential, with r² + 2 x²"},
};

inline constexpr LensInfo mei_info = {
    .name = "mei",
    .group = "calibrated",
    .also = "omnidir, omni, omni-radtan, omni-none, unified, cata",
    .formula = "r' = r (1 + k1 r² + k2 r⁴), r = sin θ / (cos θ + ξ); and p1, p2",
    .source = "Mei, Rives 2007, Single view point omnidirectional camera calibration; OpenCV 4.6 omnidir",
    .example =
        "mei:fx=2138.7619122017772,fy=2131.5886210259278,cx=361.69856633263799,cy=248.77644773395667,"
        "width=752,height=480,xi=3.6313355285286337,k1=1.1757726639872075,k2=15.491281051140213,"
        "p1=-0.00081237172954550494,p2=0.00067297684030310243",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::shorter,
    .radial = true,
    .skewed = true,
    .parameters = mei_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double xi = parameters.k[0], r = parameters.k[5];
          const double ray = (xi + std::sqrt(std::max(1 + (1 - xi * xi) * r * r, 0.0))) / (1 + r * r);
          return std::atan2(ray * r, ray - xi);
        },
    // The radius before distortion up to which there is a ray and the one after it rises and is no other's.
    .derive =
        [](LensParameters& parameters) {
          auto& k = parameters.k;
          const double top[] = {1.0, k[1], k[2]}, bottom[] = {1.0};
          k[5] = invertible_radius(mei_distortion(parameters), rational_rise(top, bottom));
          if (k[0] > 1) k[5] = std::min(k[5], 1 / std::sqrt(k[0] * k[0] - 1));
        },
};
#endif

LENS_FUNCTION bool mei_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec2 across = vec2(direction.x, direction.y);
  real xi = params.k[0];
  real far = xi * length(direction);
  // Behind, far + z would lose most digits.
  real z =
      direction.z > real(0.0)
          ? far + direction.z
          : (xi * xi * dot(across, across) + (xi * xi - real(1.0)) * direction.z * direction.z) / (far - direction.z);
  plane = vec2(real(0.0));
  if (!(z > real(0.0)) || angle_from_axis(direction) > params.max_angle) return false;
  vec4 slope;
  distort(mei_distortion(params), across / z, plane, slope);
  return true;
}

LENS_FUNCTION bool mei_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real xi = params.k[0];
  vec2 u;
  bool valid = undistort(mei_distortion(params), plane, params.k[5], u);
  real s = dot(u, u);
  real inner = real(1.0) + (real(1.0) - xi * xi) * s;
  real ray = (xi + sqrt(max(inner, real(0.0)))) / (real(1.0) + s);
  direction = normalize(vec3(u.x * ray, u.y * ray, ray - xi));
  return valid && inner >= real(0.0) && angle_from_axis(direction) <= params.max_angle;
}
