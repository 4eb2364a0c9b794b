// Every triangle into one piece.
#include "technique/mesh_input.glsl"
#include "technique/piecewise/piece_vertex.glsl"

uniform uint piece;

void main() {
  read_vertex();
  place_vertex(piece, vertex.position);
}
