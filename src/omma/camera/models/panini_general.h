// Panini's projection with the parameters of Hugin's "general Panini": the same formula, its distance given by a
// compression from 0 (perspective) over 100 (close to d = 1) to 150 (orthographic), its squeezes in hundredths.
#ifdef __cplusplus
inline constexpr LensParameterInfo panini_general_parameters[] = {
    {"compression", 100, 0, 149, "0 to 150 in Hugin: how far behind the cylinder it is seen from"},
    {"tops", 0, -100, 100, "squeeze above the horizon, hundredths"},
    {"bots", 0, -100, 100, "squeeze below the horizon, hundredths"},
};

inline constexpr LensInfo panini_general_info = {
    .name = "panini_general",
    .group = "panoramic",
    .also = "general_panini",
    .formula = "as panini, d = 1.5 / (3 - compression/50 + 0.0001) - 1.5 / 3.0001",
    .source = "Hugin Panini General (19), libpano13",
    .example = "panini_general:fov_deg=160,compression=80,tops=-30,bots=-10",
    .default_fov_deg = 150,
    .max_fov_deg = 358,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = panini_general_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double d = parameters.k[3];
          return std::acos(-std::min(d, d > 0.0 ? 1.0 / d : 0.0)) - open_end;
        },
    // The distance behind the axis, as libpano13 scales it.
    .derive =
        [](LensParameters& parameters) {
          parameters.k[3] = 1.5 / ((150.0 - parameters.k[0]) / 50.0 + 1e-4) - 1.5 / 3.0001;
        },
};
#endif

#ifndef __cplusplus
#include "models/panini.h"
#endif

LENS_FUNCTION bool panini_general_project(Params params, vec3 direction, OUT(vec2) plane) {
  bool valid = panini_to_plane(params.k[3], real(0.01) * vec2(params.k[1], params.k[2]), direction, plane);
  return valid && within_angle(params, direction);
}

LENS_FUNCTION bool panini_general_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  bool valid = panini_from_plane(params.k[3], real(0.01) * vec2(params.k[1], params.k[2]), plane, direction);
  return valid && within_angle(params, direction);
}
