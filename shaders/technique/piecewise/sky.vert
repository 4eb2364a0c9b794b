// The pieces' polygons with their rays, for what lies behind the scene. The last are drawn first: where pieces overlap the
// earlier one is seen.
#include "common/piece_camera.glsl"

uniform vec2 pixel_offset;  // the tile's corner and the sub-pixel shift of this pass
uniform vec2 tile_size;     // pixels
uniform int piece_count;

noperspective out vec3 ray;  // any length; linear in the image

void main() {
  int piece = piece_count - 1 - gl_InstanceID;
  vec4 corners = texelFetch(camera_pieces, piece * CAMERA_PIECE_TEXELS + (gl_VertexID >> 1));
  vec2 pixel = (gl_VertexID & 1) == 0 ? corners.xy : corners.zw;
  ray = camera_rayFromImage(piece) * vec3(pixel, 1.0);
  gl_Position = vec4((pixel - pixel_offset) / tile_size * 2.0 - 1.0, 0.0, 1.0);
}
