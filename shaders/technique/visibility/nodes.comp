// A group against the children of a node that it reaches.
#include "technique/visibility/bodies.glsl"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

uniform uint node_first, child_first, child_count;  // of their levels

void main() {
  uint number = invocation() >> 4;
  if (number >= task_count()) return;
  uvec2 task = task_at(number);  // group, node
  uint child = 16u * (task.y - node_first) + (invocation() & 15u);
  if (child >= child_count) return;
  uvec2 placed = texelFetch(placed_group_texels, int(task.x)).xy;
  bool seen = may_see(group_of(placed.y), placement_of(placed.x), node_of(child_first + child));
  append_if(seen, uvec2(task.x, child_first + child));
}
