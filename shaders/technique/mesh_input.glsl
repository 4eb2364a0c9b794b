// A vertex from the scene's vertex array.
#include "technique/vertex_output.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in uvec4 in_attributes;
layout(location = 2) in vec4 in_color;
layout(location = 3) in uvec2 in_part;

void read_vertex() {
  InstanceRecord instance = instance_of(in_part.x);
  write_vertex(instance, to_camera(instance, in_position), in_attributes, in_color, in_part);
}
