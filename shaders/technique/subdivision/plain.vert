// A vertex of a triangle that is straight as it is.
#include "technique/mesh_input.glsl"
#include "technique/subdivision/screen.glsl"

layout(binding = 18) uniform samplerBuffer pixels;
layout(binding = 19) uniform usamplerBuffer pixel_offsets;  // of each instance

void main() {
  read_vertex();
  uint at = uint(gl_VertexID) + texelFetch(pixel_offsets, int(in_part.x)).x;
  gl_Position = clip_position(texelFetch(pixels, int(at)).xy, vertex.position);
}
