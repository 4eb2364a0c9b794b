// A vertex into a piece: one matrix, and clipping to the piece a little enlarged.
#include "technique/vertex_output.glsl"
#include "technique/piecewise/pieces.glsl"

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};
flat out uint vertex_piece;

void place_vertex(uint piece, vec3 position) {
  vertex_piece = piece;
  gl_Position = piece_clip(piece, position);
  for (int side = 0; side < 4; ++side) gl_ClipDistance[side] = piece_clip_distance(piece, side, position);
}
