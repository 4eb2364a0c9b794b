// What all cube layouts share: the faces and what each of them shows. Faces are numbered in ffmpeg's default order
// `rludfb`: right, left, up, down, front, back. A face's u runs to its right and v down, each from -1 to 1; upright
// seen from the middle, where the up and down faces hang on the front one.

// Of any length.
LENS_FUNCTION vec3 cube_direction(int face, vec2 uv) {
  if (face == 0) return vec3(real(1.0), uv.y, -uv.x);
  if (face == 1) return vec3(real(-1.0), uv.y, uv.x);
  if (face == 2) return vec3(uv.x, real(-1.0), uv.y);
  if (face == 3) return vec3(uv.x, real(1.0), -uv.y);
  if (face == 4) return vec3(uv.x, uv.y, real(1.0));
  return vec3(-uv.x, uv.y, real(-1.0));
}

LENS_FUNCTION int cube_face(vec3 direction, OUT(vec2) uv) {
  vec3 size = abs(direction);
  if (size.z >= size.x && size.z >= size.y) {
    bool front = direction.z > real(0.0);
    uv = vec2(front ? direction.x : -direction.x, direction.y) / size.z;
    return front ? 4 : 5;
  }
  if (size.x >= size.y) {
    bool right = direction.x > real(0.0);
    uv = vec2(right ? -direction.z : direction.z, direction.y) / size.x;
    return right ? 0 : 1;
  }
  bool down = direction.y > real(0.0);
  uv = vec2(direction.x, down ? -direction.z : direction.z) / size.y;
  return down ? 3 : 2;
}

// The face whose cell a point of the plane is in, and where in it. Cells are two units wide and high, in `columns`
// columns and 6 / `columns` rows, left to right and top to bottom, around the plane's origin.
LENS_FUNCTION int cube_cell(int columns, vec2 plane, OUT(vec2) uv) {
  vec2 cells = vec2(real(columns), real(6 / columns));
  vec2 at = (plane + cells) * real(0.5);
  vec2 cell = clamp(floor(at), vec2(real(0.0)), cells - real(1.0));
  uv = real(2.0) * (at - cell) - real(1.0);
  return int(cell.y) * columns + int(cell.x);
}

LENS_FUNCTION bool cube_in_layout(int columns, vec2 plane) {
  return abs(plane.x) <= real(columns) && abs(plane.y) <= real(6 / columns);
}

// Stays off the cell's border by a few roundings: the other side of it is elsewhere in the world.
LENS_FUNCTION vec2 cube_plane(int columns, int cell, vec2 uv) {
  vec2 corner = vec2(real(2 * (cell % columns) + 1 - columns), real(2 * (cell / columns) + 1 - 6 / columns));
  real border = real(1.0) - real(32.0) * lens_epsilon;
  return corner + clamp(uv, vec2(-border), vec2(border));
}

LENS_FUNCTION bool cube_project(Params params, int columns, vec3 direction, OUT(vec2) plane) {
  vec2 uv;
  int face = cube_face(direction, uv);
  plane = cube_plane(columns, face, uv);
  return within_angle(params, direction);
}

LENS_FUNCTION bool cube_unproject(Params params, int columns, vec2 plane, OUT(vec3) direction) {
  vec2 uv;
  int face = cube_cell(columns, plane, uv);
  direction = normalize(cube_direction(face, uv));
  return cube_in_layout(columns, plane) && within_angle(params, direction);
}
