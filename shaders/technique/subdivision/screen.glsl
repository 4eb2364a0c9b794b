// Where points of the scene come to lie in the image.
#include "common/camera.glsl"

uniform vec2 tile_size;  // pixels

// A pixel that the lens does not give.
const float NOWHERE = 1e30;
bool is_seen(vec2 pixel) { return pixel.x < 1e29; }

vec2 pixel_of(vec3 point) {
  vec2 pixel;
  bool seen = point != vec3(0.0) && camera_project(point, pixel);
  return seen && all(lessThan(abs(pixel), vec2(1e7))) ? pixel : vec2(NOWHERE);
}

// On the rasterizer's grid of 1/256 px, so that rounding on the way there cannot open a crack.
vec2 on_grid(vec2 pixel) { return is_seen(pixel) ? round(pixel * 256.0) / 256.0 : pixel; }

// w is the distance along the ray: between two points of an edge the rasterizer then mixes their directions, and depth
// is the inverse of w as in every other technique.
vec4 clip_position(vec2 pixel, vec3 position) {
  precise float w = max(sqrt(position.x * position.x + position.y * position.y + position.z * position.z), 1e-20);
  precise vec2 device = (pixel - pixel_offset) / tile_size * 2.0 - 1.0;
  return vec4(device * w, NEAR, w);
}
