// The farthest thing that each node's rays see: from its children, or, with LEAVES, from its rays.
#include "technique/visibility/tree.glsl"

layout(local_size_x = 64) in;

layout(binding = 11) uniform usamplerBuffer seen_texels;
layout(binding = 12) uniform usamplerBuffer mask_texels;  // of each leaf: which of the sixteen are rays
layout(std430, binding = 0) writeonly buffer FarthestBlock { uint farthest[]; };
uniform uint node_first, node_count, child_first, child_count;  // of their levels

void main() {
  uint number = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (number >= node_count) return;
  uint least = NO_RAYS;
#ifdef LEAVES
  uint mask = texelFetch(mask_texels, int(number)).x;
#endif
  for (uint k = 0u; k < 16u; ++k) {
    uint child = 16u * number + k;
#ifdef LEAVES
    if ((mask >> k & 1u) == 0u) continue;
#ifdef ATOMIC_64
    least = min(least, texelFetch(seen_texels, int(child)).y);
#else
    least = min(least, texelFetch(seen_texels, int(child)).x);
#endif
#else
    if (child < child_count) least = min(least, texelFetch(farthest_texels, int(child_first + child)).x);
#endif
  }
  farthest[node_first + number] = least;
}
