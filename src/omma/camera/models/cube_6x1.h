// The six faces of a cube in 1 row of 6: right, left, up, down, front, back.
#ifdef __cplusplus
inline constexpr LensInfo cube_6x1_info = {
    .name = "cube_6x1",
    .group = "layout",
    .also = "c6x1",
    .formula = "faces right, left, up, down, front, back; u = x/z, v = y/z on each",
    .source = "ffmpeg v360 c6x1",
    .example = "cube_6x1:width=1200,height=200",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-6.0, -1.0}, {6.0, 1.0}};
    },
    .parts = [](const LensParameters&) { return plane_squares(6, 1); },
};
#else
#include "models/cube.h"
#endif

LENS_FUNCTION bool cube_6x1_project(Params params, vec3 direction, OUT(vec2) plane) {
  return cube_project(params, 6, direction, plane);
}

LENS_FUNCTION bool cube_6x1_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  return cube_unproject(params, 6, plane, direction);
}
