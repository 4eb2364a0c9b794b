// How many groups there are at each distance.
#include "technique/visibility/bodies.glsl"
#include "technique/visibility/distance.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer StepBlock { uint groups_at[]; };
uniform uint group_count;

void main() {
  uint number = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (number >= group_count) return;
  uvec2 placed = texelFetch(placed_group_texels, int(number)).xy;
  atomicAdd(groups_at[distance_step(group_of(placed.y), placement_of(placed.x))], 1u);
}
