// Every vertex of every instance to its pixel, once: whoever draws it, it lies at the same place.
#include "common/geometry.glsl"
#include "technique/subdivision/screen.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 3) in uvec2 in_part;

layout(xfb_buffer = 0, xfb_offset = 0, xfb_stride = 8) out vec2 out_pixel;

void main() {
  out_pixel = on_grid(pixel_of(to_camera(instance_of(in_part.x), in_position)));
}
