// Whose a sample is. Clipping the same edge to two pieces rounds it twice, so no two pieces draw a sample because of
// how they were clipped: they overlap a little, and each sample is given to one of them, in whole numbers.
#include "common/polygon_side.glsl"

// Of each piece, in its tile's grid (1/256 px): four corners, clockwise as seen (triangles repeat the last); the ways
// from each to the next, shortened by common factors; flags.
layout(binding = 17) uniform isamplerBuffer polygon_texels;
const int POLYGON_TEXELS = 5;
const int PIECE_MIRRORED = 1;   // shows the world's mirror image
const int PIECE_WIDE = 2;       // products of its sides do not fit in 32 bits
const int PIECE_CONTESTED = 4;  // an earlier piece lies over a part of it

uniform ivec2 sample_places[SAMPLES];  // within a pixel, in 1/256 px

int piece_flags(uint piece) { return texelFetch(polygon_texels, int(piece) * POLYGON_TEXELS + 4).x; }

int samples_beside(ivec2 side, ivec2 offset, bool wide) {
  int at_pixel = side_of(side, offset, wide) - (owns_border(side) ? 0 : 1);
  int beside = 0;
  for (int s = 0; s < SAMPLES; ++s) {
    ivec2 place = sample_places[s];
    beside |= at_pixel + side.x * place.y - side.y * place.x >= 0 ? 1 << s : 0;
  }
  return beside;
}

// The samples of a pixel of the tile that are a piece's polygon's, as bits.
int samples_within(uint piece, ivec2 pixel) {
  int at = int(piece) * POLYGON_TEXELS;
  ivec2 place = pixel * 256;
  bool wide = (piece_flags(piece) & PIECE_WIDE) != 0;
  int within = (1 << SAMPLES) - 1;
  for (int pair = 0; pair < 2; ++pair) {
    ivec4 corners = texelFetch(polygon_texels, at + pair);
    ivec4 sides = texelFetch(polygon_texels, at + 2 + pair);
    within &= samples_beside(sides.xy, place - corners.xy, wide) & samples_beside(sides.zw, place - corners.zw, wide);
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
  if ((piece_flags(piece) & PIECE_CONTESTED) == 0) return samples;
  for (int s = 0; s < SAMPLES; ++s) {
    if ((samples & 1 << s) != 0 && lies_under_another(piece, pixel, s)) samples &= ~(1 << s);
  }
  return samples;
}
#else
int samples_of(uint piece, ivec2 pixel) { return samples_within(piece, pixel); }
#endif
