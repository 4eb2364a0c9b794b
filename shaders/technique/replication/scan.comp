// One level of the prefix sums: each invocation sums 64 values.
#include "technique/replication/offsets.glsl"

layout(local_size_x = 64) in;

uniform int level;

void main() {
  uint block = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (block >= level_sizes[level + 1]) return;
  uint last = min(64u * block + 64u, level_sizes[level]);
  uint sum = 0u;
  for (uint i = 64u * block; i < last; ++i) {
    uint value = counts[level_first[level] + i];
    counts[level_first[level] + i] = sum;
    sum += value;
  }
  counts[level_first[level + 1] + block] = sum;
}
