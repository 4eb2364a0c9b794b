// The clusters of a group against a node that the group reaches.
#include "technique/visibility/bodies.glsl"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

void main() {
  uint number = invocation() >> 4, k = invocation() & 15u;
  if (number >= task_count()) return;
  uvec2 task = task_at(number);  // group, node
  uvec2 placed = texelFetch(placed_group_texels, int(task.x)).xy;
  Box group = group_of(placed.y);
  if (k >= group.count) return;
  bool seen = may_see(cluster_of(group.first + k), placement_of(placed.x), node_of(task.y));
  append_if(seen, uvec2(task.x << 4 | k, task.y));
}
