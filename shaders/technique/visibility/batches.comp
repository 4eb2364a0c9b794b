// Where batches of groups end, each four times as large as all before it.
#include "technique/visibility/bodies.glsl"
#include "technique/visibility/distance.glsl"

layout(local_size_x = 1) in;

layout(std430, binding = 0) readonly buffer StepBlock { uint groups_at[]; };
layout(std430, binding = 1) writeonly buffer BatchBlock { uint batch_end[]; };  // steps
uniform uint group_count;
uniform uint batch_count;

void main() {
  uint batch = 0u, sum = 0u;
  for (uint i = 0u; i < DISTANCE_STEPS && batch + 1u < batch_count; ++i) {
    sum += groups_at[i];
    while (batch + 1u < batch_count && sum >= (group_count >> (2u * (batch_count - 1u - batch)))) {
      batch_end[batch++] = i + 1u;
    }
  }
  while (batch < batch_count) batch_end[batch++] = DISTANCE_STEPS;
}
