// The visible triangles of a picture, and which of them each pixel sees: a place in their list, or nothing. Whoever finds
// them fills such tables.
#include "common/geometry.glsl"

layout(binding = 4) uniform usamplerBuffer visible_pixels;     // by pixel, rows from the top
layout(binding = 10) uniform usamplerBuffer visible_triangles;  // x: the triangle's number, y: its instance
uniform int visible_width;                                      // pixels in a row

const uint NOTHING = 0xffffffffu;

uint visible_at(ivec2 pixel) {
  return texelFetch(visible_pixels, pixel.y * visible_width + pixel.x).x;
}
