// A cluster against a node: the clusters of a group, or, with CHILDREN, one cluster against the node's children.
#include "technique/visibility/bodies.glsl"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

#ifdef CHILDREN
uniform uint node_first, child_first, child_count;  // of their levels
#endif

void main() {
  uint number = invocation() >> 4, k = invocation() & 15u;
  if (number >= task_count()) return;
  uvec2 task = task_at(number);
#ifdef CHILDREN
  uint cluster = task.x, child = 16u * (task.y - node_first) + k;
  if (child >= child_count) return;
  uint node = child_first + child;
#else
  uint cluster = task.x << 4 | k, node = task.y;
#endif
  uvec2 placed = texelFetch(placed_group_texels, int(cluster >> 4)).xy;
  Box group = group_of(placed.y);
  if ((cluster & 15u) >= group.count) return;
  bool seen = may_see(cluster_of(group.first + (cluster & 15u)), placement_of(placed.x), node_of(node));
  append_if(seen, uvec2(cluster, node));
}
