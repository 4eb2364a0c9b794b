// Replicated triangles, three vertices each.
#include "technique/piecewise/pulled_vertex.glsl"

layout(std430, binding = 7) readonly buffer ReplicaBlock { uvec2 replicas[]; };  // item, piece

void main() {
  uvec2 replica = replicas[gl_VertexID / 3];
  pull_vertex(replica.x, replica.y, gl_VertexID % 3);
}
