// A draw of the replicas of each range of slots.
#include "technique/piecewise/offsets.glsl"

layout(local_size_x = 64) in;

struct DrawCommand { uint count, instance_count, first, base_instance; };  // as glDrawArraysIndirect reads it

layout(std430, binding = 1) readonly buffer RangeBlock { uvec2 ranges[]; };  // of slots, the last one excluded
layout(std430, binding = 2) writeonly buffer CommandBlock { DrawCommand commands[]; };

uniform uint range_count;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= range_count) return;
  uint first = offset_of(ranges[i].x), end = offset_of(ranges[i].y);
  commands[i] = DrawCommand(3u * (end - first), 1u, 3u * first, 0u);
}
