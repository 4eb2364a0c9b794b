// A camera in the pieces form: the piece that a pixel belongs to, found as in camera/pieces/piece_set.cpp.
#include "common/polygon_side.glsl"

// Of each piece: its four corners (triangles repeat the last), pixels, and the columns of rayFromImage.
layout(binding = 8) uniform samplerBuffer camera_pieces;
const int CAMERA_PIECE_TEXELS = 5;
// Squares over the image and one more all around: which pieces reach into each, in the order in which they are seen.
layout(binding = 12) uniform usamplerBuffer camera_bin_first;
layout(binding = 13) uniform usamplerBuffer camera_bin_pieces;
uniform ivec2 camera_bin_counts;
uniform int camera_bin_side;

mat3 camera_rayFromImage(int piece) {
  int at = piece * CAMERA_PIECE_TEXELS + 2;
  return mat3(texelFetch(camera_pieces, at).xyz, texelFetch(camera_pieces, at + 1).xyz,
              texelFetch(camera_pieces, at + 2).xyz);
}

bool camera_piece_owns(int piece, ivec2 place) {
  vec4 first = texelFetch(camera_pieces, piece * CAMERA_PIECE_TEXELS) * 256.0;
  vec4 second = texelFetch(camera_pieces, piece * CAMERA_PIECE_TEXELS + 1) * 256.0;
  ivec2 corner[4] = ivec2[4](ivec2(first.xy), ivec2(first.zw), ivec2(second.xy), ivec2(second.zw));
  for (int k = 0; k < 4; ++k) {
    ivec2 side = corner[(k + 1) & 3] - corner[k];
    if (side_of(side, place - corner[k], true) - (owns_border(side) ? 0 : 1) < 0) return false;
  }
  return true;
}

// -1 where no piece has the pixel.
int camera_piece(vec2 pixel) {
  ivec2 bin = ivec2(floor(pixel / float(camera_bin_side))) + 1;
  if (any(lessThan(bin, ivec2(0))) || any(greaterThanEqual(bin, camera_bin_counts))) return -1;
  ivec2 place = ivec2(round(pixel * 256.0));
  int number = bin.y * camera_bin_counts.x + bin.x;
  uint last = texelFetch(camera_bin_first, number + 1).x;
  for (uint i = texelFetch(camera_bin_first, number).x; i < last; ++i) {
    int piece = int(texelFetch(camera_bin_pieces, int(i)).x);
    if (camera_piece_owns(piece, place)) return piece;
  }
  return -1;
}

bool camera_unproject(vec2 pixel, out vec3 direction) {
  int piece = camera_piece(pixel);
  direction = piece >= 0 ? normalize(camera_rayFromImage(piece) * vec3(pixel, 1.0)) : vec3(0.0, 0.0, -1.0);
  return piece >= 0;
}
