// The triangles of a cluster against the leaves of a block.
#include "technique/visibility/turned_triangle.glsl"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

uniform uint node_first;  // of the blocks' level

void main() {
  uint number = invocation() >> 4, k = invocation() & 15u;
  if (number >= task_count()) return;
  uvec2 task = task_at(number);
  uint slot = task.x << 4 | k;
  TurnedTriangle t;
  bool seen = turned_triangle(slot, t);
  seen = seen && may_see(t, node_of(task.y));
  uint leaf = 16u * (task.y - node_first), end = seen ? leaf + 16u : leaf;
  for (; leaf < end; ++leaf) append_if(may_see(t, node_of(leaf)), uvec2(slot, leaf));
}
