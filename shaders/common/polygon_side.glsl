// Sides of polygons in whole numbers, 1/256 px.

// edge.x * offset.y - edge.y * offset.x, limited to +-2^30; never limited to something of another sign.
int side_of(ivec2 edge, ivec2 offset, bool wide) {
  if (!wide) return edge.x * offset.y - edge.y * offset.x;
  int high_a, high_b, low_a, low_b;
  imulExtended(edge.x, offset.y, high_a, low_a);
  imulExtended(edge.y, offset.x, high_b, low_b);
  uint borrow;
  uint low = usubBorrow(uint(low_a), uint(low_b), borrow);
  int high = high_a - high_b - int(borrow);
  if (high == 0 && low < 0x40000000u) return int(low);
  if (high == -1 && low > 0xc0000000u) return int(low);
  return high < 0 ? -0x40000000 : 0x40000000;
}

// A side owns what lies on it when it runs up (y falls), or to the right where level, as in
// camera/pieces/piece_set.h. A side without length owns everything.
bool owns_border(ivec2 side) { return side.y < 0 || (side.y == 0 && side.x >= 0); }
