// NVIDIA's f-theta: a polynomial either from the angle to the distance in pixels or from the distance to the angle
// (`reference` says which; the other direction is its exact inverse), then a linear term. The coefficients are for
// pixels, to be taken with f=1. It holds as far as the polynomial rises; NVIDIA's maximum angle is max_angle_deg, and
// its principal point counts from the centre of the first pixel: cx and cy need 0.5 added.
#ifdef __cplusplus
inline constexpr LensParameterInfo ftheta_parameters[] = {
    {"k1", 1, -1e9, 1e9, "coefficient of the angle (radians) or distance (pixels), positive"},
    {"k2", 0, -1e9, 1e9, "coefficient of its square"},
    {"k3", 0, -1e9, 1e9, "coefficient of its third power"},
    {"k4", 0, -1e9, 1e9, "coefficient of its fourth power"},
    {"k5", 0, -1e9, 1e9, "coefficient of its fifth power"},
    {"c", 1, 0.1, 10, "linear term, x by x: plane = (c x + d y, e x + y)"},
    {"d", 0, -0.25, 0.25, "linear term, x by y"},
    {"e", 0, -0.25, 0.25, "linear term, y by x"},
    {"reference", 0, 0, 1, "what the polynomial makes of what", "angle_to_pixeldist, pixeldist_to_angle"},
};

inline constexpr LensInfo ftheta_info = {
    .name = "ftheta",
    .group = "calibrated",
    .also = "f_theta, f-theta",
    .formula = "r = k1 θ + … + k5 θ⁵, or θ = k1 r + … + k5 r⁵; (x, y) ↦ (c x + d y, e x + y)",
    .source = "NVIDIA DriveWorks, FTheta camera model; gsplat FThetaCameraDistortionParameters",
    .example =
        "ftheta:f=1,cx=960.099793,cy=743.504822,width=1920,height=1080,max_angle_deg=77.13,"
        "k1=0.0010574288899,k2=3.8427288e-08,k3=-1.10690762e-10,k4=1.66371616e-13,k5=-6.0194548e-17,"
        "c=0.9996691346,d=3.400261676e-06,e=3.736908184e-05,reference=pixeldist_to_angle",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::shorter,
    .radial = true,
    .skewed = true,
    .parameters = ftheta_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const auto c = std::span(parameters.k).first(5);
          const double r = parameters.k[9];
          return parameters.k[8] == 0.0 ? polynomial_rise(c, pi) : std::min(pi, r * polynomial_value(c, r));
        },
    // The radius up to which the angle rises, where the polynomial gives the angle.
    .derive =
        [](LensParameters& parameters) {
          if (parameters.k[8] != 0.0) parameters.k[9] = polynomial_rise_to(std::span(parameters.k).first(5), pi);
        },
};
#else
#include "models/radial_polynomial.h"
#endif

LENS_FUNCTION bool ftheta_project(Params params, vec3 direction, OUT(vec2) plane) {
  real c[8] = {params.k[0], params.k[1], params.k[2], params.k[3], params.k[4], real(0.0), real(0.0), real(0.0)};
  real theta = angle_from_axis(direction);
  real r = params.k[8] == real(0.0) ? radial_polynomial(c, false, theta).x
                                    : radial_polynomial_inverse(c, false, theta, theta / c[0], params.k[9]);
  vec2 u;
  bool valid = radial_project(params, direction, theta, r, u);
  plane = vec2(params.k[5] * u.x + params.k[6] * u.y, params.k[7] * u.x + u.y);
  return valid;
}

LENS_FUNCTION bool ftheta_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  real c[8] = {params.k[0], params.k[1], params.k[2], params.k[3], params.k[4], real(0.0), real(0.0), real(0.0)};
  vec2 u = vec2(plane.x - params.k[6] * plane.y, params.k[5] * plane.y - params.k[7] * plane.x) /
           (params.k[5] - params.k[6] * params.k[7]);
  real r = length(u);
  bool from_angle = params.k[8] == real(0.0);
  real theta = from_angle ? radial_polynomial_inverse(c, false, r, r / c[0], params.max_angle)
                          : radial_polynomial(c, false, r).x;
  real last = from_angle ? radial_polynomial(c, false, params.max_angle).x : params.k[9];
  return radial_unproject(params, u, theta, direction) && r <= last;
}
