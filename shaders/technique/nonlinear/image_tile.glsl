// The squares of the image that are the nodes of its tree of cones. Matches technique/nonlinear/image_tiles.cpp.

// Corner and side of a node's square, pixels of the target.
ivec3 square_of(uint data) {
  return ivec3(data & 0x3fffu, data >> 14 & 0x3fffu, 1 << int(2u * (data >> 28)));
}
