// The factors of a part: its edges' were decided with the edges; within, as many rings as it takes there.
#include "technique/mesh_vertex.glsl"
#include "technique/subdivision/screen.glsl"

layout(vertices = 3) out;

uniform float tolerance;  // pixels

in MESH_VERTEX vertex_in[];
in vec2 vertex_pixel[];
flat in uvec3 vertex_halvings[];

out MESH_VERTEX corner[];
out vec2 corner_pixel[];
patch out uvec3 patch_halvings;  // of the edges 01, 12 and 20

// Four times what the middle of the edge from corner i is off.
vec2 bend(int i) {
  int j = (i + 1) % 3;
  vec2 middle = pixel_of(normalize(vertex_in[i].position) + normalize(vertex_in[j].position));
  return 2.0 * (vertex_pixel[i] + vertex_pixel[j] - 2.0 * middle);
}

// The lines within a triangle of n rings are as long as the n-th part of an edge, or as 2/3n of two edges' sum; what the
// latter is off follows from what the three edges are, as the second derivative along it does.
float inner_factor(float most) {
  vec2 edge[3] = vec2[3](bend(0), bend(1), bend(2));
  float deviation = 0.0;
  for (int i = 0; i < 3; ++i) {
    vec2 across = 2.0 * (edge[i] + edge[(i + 1) % 3]) - edge[(i + 2) % 3];
    deviation = max(deviation, 0.25 * max(length(edge[i]), 4.0 / 9.0 * length(across)));
  }
  return clamp(ceil(sqrt(deviation / tolerance)), 2.0, 2.0 * most);  // edges outside the image may be off by more
}

void main() {
  corner[gl_InvocationID].position = vertex_in[gl_InvocationID].position;
  corner[gl_InvocationID].normal = vertex_in[gl_InvocationID].normal;
  corner[gl_InvocationID].tangent = vertex_in[gl_InvocationID].tangent;
  corner[gl_InvocationID].uv = vertex_in[gl_InvocationID].uv;
  corner[gl_InvocationID].color = vertex_in[gl_InvocationID].color;
  corner[gl_InvocationID].part = vertex_in[gl_InvocationID].part;
  corner_pixel[gl_InvocationID] = vertex_pixel[gl_InvocationID];
  if (gl_InvocationID != 0) return;
  patch_halvings = vertex_halvings[0];
  vec3 factors = vec3(uvec3(1u) << patch_halvings);
  float most = max(max(factors.x, factors.y), factors.z);
  // Numbered by the corners opposite.
  gl_TessLevelOuter[0] = factors.y;
  gl_TessLevelOuter[1] = factors.z;
  gl_TessLevelOuter[2] = factors.x;
  gl_TessLevelInner[0] = most > 1.0 ? inner_factor(most) : 1.0;
}
