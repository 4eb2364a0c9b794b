// Each pixel's material as a depth, so that the depth test sends every pixel to the program of its own material.
#include "technique/visible.glsl"

void main() {
  uvec2 hit = texelFetch(visible, ivec2(gl_FragCoord.xy), 0).xy;
  if (hit.y == NOTHING) discard;
  gl_FragDepth = float(instance_of(hit.y).numbers.z + 1u) / 16777216.0;
}
