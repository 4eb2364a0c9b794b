// Which pieces a triangle reaches: a tree of cones over the pieces, then the separating planes of the triangle's and
// the piece's pyramids, which for two convex pyramids with one apex decide exactly.
#include "technique/piecewise/pieces.glsl"
#include "technique/replication/cone_tree.glsl"

bool reaches(Pyramid pyramid, uint piece) {
  for (int k = 0; k < 4; ++k) {
    vec3 plane = piece_plane(piece, k);
    if (dot(plane, pyramid.corner[0]) < 0.0 && dot(plane, pyramid.corner[1]) < 0.0 &&
        dot(plane, pyramid.corner[2]) < 0.0) {
      return false;
    }
  }
  vec3 ray[4] = vec3[4](piece_ray(piece, 0), piece_ray(piece, 1), piece_ray(piece, 2), piece_ray(piece, 3));
  for (int i = 0; i < 3; ++i) {
    vec3 side = pyramid.side[i];
    if (dot(side, ray[0]) < -LEEWAY && dot(side, ray[1]) < -LEEWAY && dot(side, ray[2]) < -LEEWAY &&
        dot(side, ray[3]) < -LEEWAY) {
      return false;
    }
  }
  return true;
}

// The next piece that the triangle reaches, from `node` on and before `end`; NO_PIECE when there is none.
uint next_piece(Pyramid pyramid, inout int node, int end) {
  while (node < end) {
    Node next = node_of(node);
    if (!may_reach(pyramid, next)) {
      node = next.skip;
      continue;
    }
    ++node;
    if (next.piece != NO_PIECE && reaches(pyramid, next.piece)) return next.piece;
  }
  return NO_PIECE;
}
