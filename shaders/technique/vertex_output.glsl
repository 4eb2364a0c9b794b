// From a vertex as the scene stores it to what the rasterizer is given, in the camera frame.
#include "technique/mesh_vertex.glsl"

out MESH_VERTEX vertex;

void write_vertex(InstanceRecord instance, vec3 position, uvec4 attributes, vec4 color, uvec2 part) {
  vertex.position = position;
  vertex.normal = normal_to_camera(instance, vertex_normal(attributes));
#ifdef TANGENTS
  vec4 tangent = vertex_tangent(attributes);
  vertex.tangent = vec4(direction_to_camera(instance, tangent.xyz), tangent.w);
#else
  vertex.tangent = vec4(0.0);
#endif
  vertex.uv = vertex_uv(attributes);
  vertex.color = color;
  vertex.part = part;
}
