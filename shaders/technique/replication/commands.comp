// A draw of the replicas of each range of slots.
#include "technique/replication/offsets.glsl"

layout(local_size_x = 64) in;

// As glDrawArraysIndirect and glDrawElementsIndirect read it: all that follows `first` is zero for both.
struct DrawCommand { uint count, instance_count, first, base_vertex, base_instance; };

layout(std430, binding = 1) readonly buffer RangeBlock { uvec2 ranges[]; };  // of slots, the last one excluded
layout(std430, binding = 2) writeonly buffer CommandBlock { DrawCommand commands[]; };

uniform uint range_count;
uniform uint indices_per_replica;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= range_count) return;
  uint first = offset_of(ranges[i].x), end = offset_of(ranges[i].y);
  commands[i] = DrawCommand(indices_per_replica * (end - first), 1u, indices_per_replica * first, 0u, 0u);
}
