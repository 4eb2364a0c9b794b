// Truncated square pyramid: the front face of a cube takes half of the image, and the right half holds the others, the
// back face small in its middle and the four sides as trapezoids that join it to the border.
#ifdef __cplusplus
inline constexpr LensInfo pyramid_info = {
    .name = "pyramid",
    .group = "layout",
    .also = "tsp, truncated_square_pyramid",
    .formula = "front: left half; back: a quarter of the right half; sides: trapezoids between",
    .source = "Van der Auwera, Coban, Karczewicz 2016, JVET-D0071; ffmpeg v360 tsp",
    .example = "pyramid:width=960,height=480",
    .default_fov_deg = 0,
    .max_fov_deg = 0,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = {},
    .max_angle = [](const LensParameters&) { return pi; },
    .frame = [](const LensParameters&) -> std::optional<PlaneRectangle> {
      return PlaneRectangle{{-2.0, -1.0}, {2.0, 1.0}};
    },
    .parts = [](const LensParameters&) -> std::vector<PlanePolygon> {
      // Front, back, and the sides between the back and the border.
      return {{{-2.0, -1.0}, {0.0, -1.0}, {0.0, 1.0}, {-2.0, 1.0}},
              {{0.75, -0.25}, {1.25, -0.25}, {1.25, 0.25}, {0.75, 0.25}},
              {{0.0, -1.0}, {0.75, -0.25}, {0.75, 0.25}, {0.0, 1.0}},
              {{0.0, -1.0}, {2.0, -1.0}, {1.25, -0.25}, {0.75, -0.25}},
              {{2.0, -1.0}, {2.0, 1.0}, {1.25, 0.25}, {1.25, -0.25}},
              {{2.0, 1.0}, {0.0, 1.0}, {0.75, 0.25}, {1.25, 0.25}}};
    },
};
#else
#include "models/cube.h"
#endif

// The right half of the image is a square of which the back face takes the middle, half as wide as the ring around it
// is at both sides; `inward` runs from the border (0) to the back face (1) and shrinks a side's breadth from 1 to 1/4.
const real pyramid_ring = real(0.75);

LENS_FUNCTION bool pyramid_project(Params params, vec3 direction, OUT(vec2) plane) {
  vec2 uv;
  int face = cube_face(direction, uv);
  vec2 square = uv;
  if (face == 5) {
    square = real(0.25) * uv;
  } else if (face < 4) {
    // On each side the front edge lies on the border.
    real inward = face == 0 ? uv.x : face == 1 ? -uv.x : face == 2 ? -uv.y : uv.y;
    real out_of_middle = real(1.0) - real(0.5) * pyramid_ring * (inward + real(1.0));
    real along = out_of_middle * (face < 2 ? uv.y : uv.x);
    // Turned over, as the back face is: right of the world is at the left.
    if (face == 0) square = vec2(-out_of_middle, along);
    if (face == 1) square = vec2(out_of_middle, along);
    if (face == 2) square = vec2(-along, -out_of_middle);
    if (face == 3) square = vec2(-along, out_of_middle);
  }
  plane = vec2(face == 4 ? real(-1.0) : real(1.0), real(0.0)) + square;
  return within_angle(params, direction);
}

LENS_FUNCTION bool pyramid_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  vec2 square = vec2(plane.x < real(0.0) ? plane.x + real(1.0) : plane.x - real(1.0), plane.y);
  vec2 size = abs(square);
  real out_of_middle = max(size.x, size.y);
  int face = 4;
  vec2 uv = square;
  if (plane.x >= real(0.0)) {
    real inward = real(2.0) * (real(1.0) - out_of_middle) / pyramid_ring - real(1.0);
    if (out_of_middle <= real(1.0) - pyramid_ring) {
      face = 5;
      uv = square / (real(1.0) - pyramid_ring);
    } else if (size.x >= size.y) {
      face = square.x < real(0.0) ? 0 : 1;
      uv = vec2(face == 0 ? inward : -inward, square.y / out_of_middle);
    } else {
      face = square.y < real(0.0) ? 2 : 3;
      uv = vec2(-square.x / out_of_middle, face == 2 ? -inward : inward);
    }
  }
  direction = normalize(cube_direction(face, uv));
  return abs(plane.x) <= real(2.0) && abs(plane.y) <= real(1.0) && within_angle(params, direction);
}
