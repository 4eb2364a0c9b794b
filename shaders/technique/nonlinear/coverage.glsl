// The squares of the image that a triangle reaches: leaves, and whole nodes that lie within it.

bool lies_within(Node node, Pyramid pyramid) {
  float within = node.sine + LEEWAY;
  return dot(pyramid.side[0], node.axis) > within && dot(pyramid.side[1], node.axis) > within &&
         dot(pyramid.side[2], node.axis) > within;
}

// The next node to draw, from `node` on and before `end`; NO_PIECE when there is none.
uint next_piece(Pyramid pyramid, inout int node, int end) {
  while (node < end) {
    Node next = node_of(node);
    if (!may_reach(pyramid, next)) {
      node = next.skip;
      continue;
    }
    if (next.piece == NO_PIECE && !lies_within(next, pyramid)) {
      ++node;
      continue;
    }
    uint found = uint(node);
    node = next.skip;
    return found;
  }
  return NO_PIECE;
}
