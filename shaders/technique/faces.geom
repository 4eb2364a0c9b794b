// One triangle into every cube face it may be seen in, without those that lie outside the face or face away
// (Trapp, Lorenz, Döllner 2009, section 4.2).
#include "technique/mesh_vertex.glsl"

layout(triangles, invocations = FACE_COUNT) in;
layout(triangle_strip, max_vertices = 3) out;

uniform mat4 face_clipFromCamera[FACE_COUNT];
uniform int layer[FACE_COUNT];
uniform float cull_sign;  // 1: faces that turn away are left out; -1: in a mirrored instance; 0: none is

in MESH_VERTEX vertex_in[];
out MESH_VERTEX vertex;

// Bits of the face's four side planes that a vertex lies beyond.
int beyond(vec4 clip) {
  return int(clip.x < -clip.w) | int(clip.x > clip.w) << 1 | int(clip.y < -clip.w) << 2 | int(clip.y > clip.w) << 3;
}

void main() {
  vec4 clip[3];
  int outside = 15;
  for (int i = 0; i < 3; ++i) {
    clip[i] = face_clipFromCamera[gl_InvocationID] * vec4(vertex_in[i].position, 1.0);
    outside &= beyond(clip[i]);
  }
  if (outside != 0) return;
  vec3 a = vertex_in[0].position, b = vertex_in[1].position, c = vertex_in[2].position;
  if (cull_sign * dot(a, cross(b - a, c - a)) > 0.0) return;
  for (int i = 0; i < 3; ++i) {
    vertex.position = vertex_in[i].position;
    vertex.normal = vertex_in[i].normal;
    vertex.tangent = vertex_in[i].tangent;
    vertex.uv = vertex_in[i].uv;
    vertex.color = vertex_in[i].color;
    vertex.part = vertex_in[i].part;
    gl_PrimitiveID = gl_PrimitiveIDIn;
    gl_Layer = layer[gl_InvocationID];
    gl_Position = clip[i];
    EmitVertex();
  }
  EndPrimitive();
}
