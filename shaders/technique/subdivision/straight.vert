// A corner of a part that is straight.
#include "technique/subdivision/record_vertex.glsl"

void main() {
  Record r = record_of(gl_VertexID / 3);
  int corner = gl_VertexID % 3;
  write_corner(r, corner);
  gl_Position = clip_position(r.pixel[corner], r.position[corner]);
}
