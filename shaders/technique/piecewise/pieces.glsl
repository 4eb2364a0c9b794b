// Pieces of a camera's image. Matches technique/piecewise/gpu_pieces.cpp.

// Of each piece: the rows of clipFromCamera for x, y and w; then, for the piece a fraction of a pixel larger all around,
// seen as a pyramid from the camera's centre, its sides (unit, pointing inwards) and its edges (unit rays), four each.
// What is clipped to the larger piece reaches every sample of the piece.
layout(binding = 16) uniform samplerBuffer piece_texels;
const int PIECE_TEXELS = 11;

uniform float near_depth;

vec3 piece_plane(uint piece, int side) { return texelFetch(piece_texels, int(piece) * PIECE_TEXELS + 3 + side).xyz; }
vec3 piece_ray(uint piece, int corner) { return texelFetch(piece_texels, int(piece) * PIECE_TEXELS + 7 + corner).xyz; }

// The same to the last bit in whichever stage.
vec4 piece_clip(uint piece, vec3 position) {
  int at = int(piece) * PIECE_TEXELS;
  precise vec4 clip = vec4(dot(texelFetch(piece_texels, at).xyz, position), dot(texelFetch(piece_texels, at + 1).xyz, position),
                           near_depth, dot(texelFetch(piece_texels, at + 2).xyz, position));
  return clip;
}

float piece_clip_distance(uint piece, int side, vec3 position) {
  precise float inside = dot(piece_plane(piece, side), position);
  return inside;
}
