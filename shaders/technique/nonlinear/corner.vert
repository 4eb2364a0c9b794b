// A corner of a triangle on its way to the shape that encloses the triangle's image.
#include "common/geometry.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 3) in uvec2 in_part;

out vec3 corner;  // camera frame
flat out uvec2 part;

void main() {
  corner = to_camera(instance_of(in_part.x), in_position);
  part = in_part;
}
