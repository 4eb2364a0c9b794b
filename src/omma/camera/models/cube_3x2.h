// The six faces of a cube in 2 rows of 3: right, left, up / down, front, back.
#ifdef __cplusplus
inline constexpr LensInfo cube_3x2_info = {
    .name = "cube_3x2",
    .group = "layout",
    .also = "c3x2, cubemap",
    .formula = "faces right, left, up / down, front, back; u = x/z, v = y/z on each",
    .source = "ffmpeg v360 c3x2",
    .example = "cube_3x2:width=720,height=480",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-3.0, -2.0}, {3.0, 2.0}};
    },
    .parts = [](const LensParameters&) { return plane_squares(3, 2); },
};
#else
#include "models/cube.h"
#endif

LENS_FUNCTION bool cube_3x2_project(Params params, vec3 direction, OUT(vec2) plane) {
  return cube_project(params, 3, direction, plane);
}

LENS_FUNCTION bool cube_3x2_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  return cube_unproject(params, 3, plane, direction);
}
