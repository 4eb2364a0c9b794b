// A vertex as the scene stores it, brought into the camera frame.
#include "technique/mesh_vertex.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in uvec4 in_attributes;
layout(location = 2) in vec4 in_color;
layout(location = 3) in uvec2 in_part;

out MESH_VERTEX vertex;

void read_vertex() {
  InstanceRecord instance = instances[in_part.x];
  vertex.position = to_camera(instance, in_position);
  vertex.normal = normal_to_camera(instance, vertex_normal(in_attributes));
#ifdef NORMAL_TEXTURE
  vec4 tangent = vertex_tangent(in_attributes);
  vertex.tangent = vec4(direction_to_camera(instance, tangent.xyz), tangent.w);
#else
  vertex.tangent = vec4(0.0);
#endif
  vertex.uv = vertex_uv(in_attributes);
  vertex.color = in_color;
  vertex.part = in_part;
}
