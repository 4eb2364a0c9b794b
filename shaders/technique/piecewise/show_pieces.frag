// Thin dark lines where a pixel's piece is not its right or lower neighbour's, as in figures 5 and 7 of Lorenz and
// Döllner 2009.
#include "common/camera.glsl"

layout(location = 0) out vec4 color;

void main() {
  vec2 pixel = gl_FragCoord.xy + pixel_offset;
  int here = camera_piece(pixel), right = camera_piece(pixel + vec2(1.0, 0.0)), below = camera_piece(pixel + vec2(0.0, 1.0));
  bool border = (right >= 0 && right != here) || (below >= 0 && below != here);  // the image's own is none
  if (!border) discard;
  color = vec4(0.0, 0.0, 0.0, 1.0);
}
