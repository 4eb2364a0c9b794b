// Whose a sample is. Clipping the same edge to two pieces rounds it twice, so no two pieces draw a sample because of
// how they were clipped: they overlap a little, and each sample is given to one of them, in whole numbers.
#include "technique/piecewise/pieces.glsl"
#include "common/polygon_side.glsl"

uniform ivec2 sample_places[SAMPLES];  // within a pixel, in 1/256 px

ivec2 corner_of(PieceRecord record, int k) { return (k & 1) == 0 ? record.corners[k >> 1].xy : record.corners[k >> 1].zw; }
ivec2 side_vector(PieceRecord record, int k) { return (k & 1) == 0 ? record.sides[k >> 1].xy : record.sides[k >> 1].zw; }

// The samples of a pixel of the tile that are a piece's polygon's, as bits.
int samples_within(uint piece, ivec2 pixel) {
  PieceRecord record = pieces[piece];
  bool wide = (record.flags.x & PIECE_WIDE) != 0;
  int within = (1 << SAMPLES) - 1;
  for (int k = 0; k < 4; ++k) {
    ivec2 side = side_vector(record, k);
    int at_pixel = side_of(side, pixel * 256 - corner_of(record, k), wide) - (owns_border(side) ? 0 : 1);
    for (int s = 0; s < SAMPLES; ++s) {
      ivec2 place = sample_places[s];
      if (at_pixel + side.x * place.y - side.y * place.x < 0) within &= ~(1 << s);
    }
  }
  return within;
}

#ifdef OVERLAPPING_PIECES
// Squares of the image and the pieces that reach into each, in the order in which they lie over each other.
layout(binding = 10) uniform usamplerBuffer bin_first;
layout(binding = 11) uniform usamplerBuffer bin_pieces;
uniform ivec2 bin_origin;  // from the first square's corner to the tile's, 1/256 px
uniform ivec2 bin_counts;
uniform int bin_side;  // 1/256 px

bool lies_under_another(uint piece, ivec2 pixel, int s) {
  ivec2 bin = (pixel * 256 + sample_places[s] + bin_origin) / bin_side;
  if (any(lessThan(bin, ivec2(0))) || any(greaterThanEqual(bin, bin_counts))) return false;
  int number = bin.y * bin_counts.x + bin.x;
  uint last = texelFetch(bin_first, number + 1).x;
  for (uint i = texelFetch(bin_first, number).x; i < last; ++i) {
    uint other = texelFetch(bin_pieces, int(i)).x;
    if (other == piece) break;
    if ((samples_within(other, pixel) & 1 << s) != 0) return true;
  }
  return false;
}

int samples_of(uint piece, ivec2 pixel) {
  int samples = samples_within(piece, pixel);
  if ((pieces[piece].flags.x & PIECE_CONTESTED) == 0) return samples;
  for (int s = 0; s < SAMPLES; ++s) {
    if ((samples & 1 << s) != 0 && lies_under_another(piece, pixel, s)) samples &= ~(1 << s);
  }
  return samples;
}
#else
int samples_of(uint piece, ivec2 pixel) { return samples_within(piece, pixel); }
#endif
