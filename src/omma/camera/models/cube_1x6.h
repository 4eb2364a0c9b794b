// The six faces of a cube in 6 rows of 1: right, left, up, down, front, back.
#ifdef __cplusplus
inline constexpr LensInfo cube_1x6_info = {
    .name = "cube_1x6",
    .group = "layout",
    .also = "c1x6",
    .formula = "faces right, left, up, down, front, back; u = x/z, v = y/z on each",
    .source = "ffmpeg v360 c1x6",
    .example = "cube_1x6:width=200,height=1200",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-1.0, -6.0}, {1.0, 6.0}};
    },
    .parts = [](const LensParameters&) { return plane_squares(1, 6); },
};
#else
#include "models/cube.h"
#endif

LENS_FUNCTION bool cube_1x6_project(Params params, vec3 direction, OUT(vec2) plane) {
  return cube_project(params, 1, direction, plane);
}

LENS_FUNCTION bool cube_1x6_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  return cube_unproject(params, 1, plane, direction);
}
