// Scaramuzza's omnidirectional camera, as OCamCalib and MATLAB calibrate it: the ray of a plane point is (x, y, -p(r)),
// p a polynomial whose constant term is negative. The coefficients are for pixels, to be taken with f=1. It holds as
// far as the angle rises with the radius; the polynomial the other way round that the files hold too is not needed.
//
// OCamCalib's first image axis is the row: c, d, e are (row, column) = (c row + d column, e row + column). Its C code
// counts the centre from 0, MATLAB from 1: our cx is its column + 0.5 or − 0.5, cy its row.
#ifdef __cplusplus
inline constexpr LensParameterInfo ocam_parameters[] = {
    {"a0", -1, -1e9, -1e-9, "constant term, negative"},
    {"a1", 0, -1e9, 1e9, "coefficient of r; MATLAB and most files leave it 0"},
    {"a2", 0, -1e9, 1e9, "coefficient of r²"},
    {"a3", 0, -1e9, 1e9, "coefficient of r³"},
    {"a4", 0, -1e9, 1e9, "coefficient of r⁴"},
    {"a5", 0, -1e9, 1e9, "coefficient of r⁵"},
    {"a6", 0, -1e9, 1e9, "coefficient of r⁶"},
    {"c", 1, 0.1, 10, "stretch of rows"},
    {"d", 0, -0.25, 0.25, "shear of rows by columns"},
    {"e", 0, -0.25, 0.25, "shear of columns by rows"},
};

inline constexpr LensInfo ocam_info = {
    .name = "ocam",
    .group = "calibrated",
    .also = "scaramuzza, ocamcalib, taylor",
    .formula = "ray = (x, y, −(a0 + a1 r + a2 r² + … + a6 r⁶))",
    .source = "Scaramuzza, Martinelli, Siegwart 2006, A toolbox for easily calibrating omnidirectional cameras",
    .example =
        "ocam:f=1,cx=798.675741,cy=794.808657,width=1600,height=1600,max_angle_deg=110,"
        "a0=-471.4441,a1=0,a2=0.0007356108,a3=-3.773045e-07,a4=5.800006e-10,a5=0,a6=0,"
        "c=1.000305,d=-0.000277,e=-0.000925",
    .default_fov_deg = 0,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::shorter,
    .radial = true,
    .skewed = true,
    .parameters = ocam_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double r = parameters.k[10];
          return std::min(pi - open_end, std::atan2(r, -polynomial_value(std::span(parameters.k).first(7), r)));
        },
    // The radius up to which the angle rises: as long as r p'(r) > p(r).
    .derive =
        [](LensParameters& parameters) {
          auto& k = parameters.k;
          const double slope[] = {-k[0], 0.0, k[2], 2 * k[3], 3 * k[4], 4 * k[5], 5 * k[6]};
          const std::vector<double> turns = polynomial_roots(slope, 0.0, -1e6 * k[0]);
          k[10] = turns.empty() ? -1e6 * k[0] : turns.front();
        },
};
#else
#include "models/radial_polynomial.h"
#endif

LENS_FUNCTION bool ocam_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec2 across = vec2(direction.x, direction.y);
  real rho = length(across);
  real scale = length(direction);
  real cosine = direction.z / scale;
  real sine = rho / scale;
  // r cos θ + p(r) sin θ is negative before the ray and positive after it.
  real c[8] = {cosine + params.k[1] * sine, params.k[2] * sine, params.k[3] * sine, params.k[4] * sine,
               params.k[5] * sine,          params.k[6] * sine, real(0.0),          real(0.0)};
  real start = real(-2.0) * params.k[0] * sine / (real(1.0) + max(cosine, real(-0.99)));
  real r = radial_polynomial_inverse(c, false, -params.k[0] * sine, start, params.k[10]);
  vec2 u = rho > real(0.0) ? across * (r / rho) : vec2(real(0.0));
  plane = vec2(u.x + params.k[9] * u.y, params.k[8] * u.x + params.k[7] * u.y);
  return angle_from_axis(direction) <= params.max_angle;
}

LENS_FUNCTION bool ocam_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  vec2 u = vec2(params.k[7] * plane.x - params.k[9] * plane.y, plane.y - params.k[8] * plane.x) /
           (params.k[7] - params.k[8] * params.k[9]);
  real r = length(u);
  real p = real(0.0);
  for (int i = 6; i >= 0; --i) p = p * r + params.k[i];
  direction = normalize(vec3(u.x, u.y, -p));
  return r <= params.k[10] && angle_from_axis(direction) <= params.max_angle;
}
