// A corner of a part that a border runs through, on its way to the geometry shader.
#include "technique/subdivision/record_vertex.glsl"

flat out vec2 vertex_pixel;
flat out uint vertex_broken;

void main() {
  Record r = record_of(gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  write_corner(r, corner);
  vertex_pixel = r.pixel[corner];
  vertex_broken = r.broken;
}
