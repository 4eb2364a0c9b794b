// Pieces of a camera's image. Matches technique/piecewise/gpu_pieces.cpp.

struct PieceRecord {
  vec4 clipFromCamera[3];  // rows of x, y and w
  // The piece a fraction of a pixel larger all around, as a pyramid from the camera's centre: what is clipped to it
  // reaches every sample of the piece.
  vec4 plane[4];  // xyz: unit, pointing inwards
  vec4 ray[4];    // xyz: unit, along its edges
  // The piece itself in its tile's grid (1/256 px), clockwise as seen; triangles repeat their last corner.
  ivec4 corners[2];  // xy, zw
  ivec4 sides[2];    // from each corner to the next, shortened by common factors
  ivec4 flags;       // x: PIECE_… bits
};

const int PIECE_MIRRORED = 1;   // shows the world's mirror image
const int PIECE_WIDE = 2;       // products of its sides do not fit in 32 bits
const int PIECE_CONTESTED = 4;  // an earlier piece lies over a part of it

layout(std430, binding = 2) readonly buffer PieceBlock { PieceRecord pieces[]; };

uniform float near_depth;

// The same to the last bit in whichever stage.
vec4 piece_clip(uint piece, vec3 position) {
  PieceRecord record = pieces[piece];
  precise vec4 clip = vec4(dot(record.clipFromCamera[0].xyz, position), dot(record.clipFromCamera[1].xyz, position),
                           near_depth, dot(record.clipFromCamera[2].xyz, position));
  return clip;
}

float piece_clip_distance(uint piece, int side, vec3 position) {
  precise float inside = dot(pieces[piece].plane[side].xyz, position);
  return inside;
}
