// Equi-angular cube map: each face's coordinates are angles, so that pixels are of nearly equal size. Left, front,
// right upright above; down, back, up below, turned so that their edges meet as well.
#ifdef __cplusplus
inline constexpr LensInfo eac_info = {
    .name = "eac",
    .group = "layout",
    .also = "equi_angular_cubemap",
    .formula = "faces left, front, right / down, back, up; u = 4/π atan(x/z), v = 4/π atan(y/z) on each",
    .source =
        "Brown 2017, Bringing pixels front and center in VR video; ffmpeg v360 eac (which adds 2 pixels of padding)",
    .example = "eac:width=720,height=480",
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

// The lower row's faces are turned by a right angle: this way from the cell to the upright face.
LENS_FUNCTION vec2 eac_upright(int cell, vec2 uv) {
  if (cell < 3) return uv;
  return cell == 4 ? vec2(uv.y, -uv.x) : vec2(-uv.y, uv.x);
}

LENS_FUNCTION vec2 eac_turned(int cell, vec2 uv) {
  if (cell < 3) return uv;
  return cell == 4 ? vec2(-uv.y, uv.x) : vec2(uv.y, -uv.x);
}

LENS_FUNCTION bool eac_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec2 uv;
  int face = cube_face(direction, uv);
  int cell = face == 1 ? 0 : face == 4 ? 1 : face == 0 ? 2 : face == 3 ? 3 : face == 5 ? 4 : 5;
  vec2 angles = vec2(atan(uv.x, real(1.0)), atan(uv.y, real(1.0))) * (real(4.0) / lens_pi);
  plane = cube_plane(3, cell, eac_turned(cell, angles));
  return within_angle(params, direction);
}

LENS_FUNCTION bool eac_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  vec2 uv;
  int cell = cube_cell(3, plane, uv);
  int face = cell == 0 ? 1 : cell == 1 ? 4 : cell == 2 ? 0 : cell == 3 ? 3 : cell == 4 ? 5 : 2;
  vec2 angles = eac_upright(cell, uv) * (real(0.25) * lens_pi);
  direction = normalize(cube_direction(face, vec2(tan(angles.x), tan(angles.y))));
  return cube_in_layout(3, plane) && within_angle(params, direction);
}
