// A corner of a part that the tessellation unit may divide further.
#include "technique/subdivision/record_vertex.glsl"

out vec2 vertex_pixel;
flat out uvec3 vertex_halvings;

void main() {
  Record r = record_of(gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  write_corner(r, corner);
  vertex_pixel = r.pixel[corner];
  vertex_halvings = max(r.decided, uvec3(1u)) - 1u;
}
