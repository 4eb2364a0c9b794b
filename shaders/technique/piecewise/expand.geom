// An item with the numbers of pieces, into those of them that it reaches.
#include "technique/piecewise/coverage.glsl"
#include "technique/replication/slots.glsl"
#include "technique/piecewise/pulled_vertex.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 3 * PIECES_A_POINT) out;

flat in uint point_item[];
flat in uint point_count[];
flat in uint point_pieces[][PIECES_A_POINT];

void main() {
  Pyramid pyramid;
  if (point_count[0] == 0u || !item_pyramid(point_item[0], pyramid)) return;
  for (uint i = 0u; i < point_count[0]; ++i) {
    uint piece = point_pieces[0][i];
    if (!reaches(pyramid, piece)) continue;
    for (int corner = 0; corner < 3; ++corner) {
      pull_vertex(point_item[0], piece, corner);
      EmitVertex();
    }
    EndPrimitive();
  }
}
