// Replicated triangles, three vertices each.
#include "technique/piecewise/pulled_vertex.glsl"

layout(binding = 21) uniform usamplerBuffer replica_texels;  // item, piece

void main() {
  uvec2 replica = texelFetch(replica_texels, gl_VertexID / 3).xy;
  pull_vertex(replica.x, replica.y, gl_VertexID % 3);
}
