// The part of the tree of cones that each cluster's triangles can reach.
#include "technique/replication/cone_tree.glsl"
#include "technique/replication/clusters.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer RangeBlock { uvec2 ranges[]; };  // nodes: first, end

void main() {
  uint number = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (number >= cluster_count) return;
  ClusterRecord cluster = cluster_of(number);
  InstanceRecord instance = instance_of(part_of(cluster.part).instance);
  vec3 centre = to_camera(instance, cluster.sphere.xyz);
  // No direction is stretched more than all three together.
  vec3 r0 = instance.cameraFromObject[0].xyz, r1 = instance.cameraFromObject[1].xyz, r2 = instance.cameraFromObject[2].xyz;
  float radius = cluster.sphere.w * sqrt(dot(r0, r0) + dot(r1, r1) + dot(r2, r2));
  float sine2 = radius * radius / dot(centre, centre);
  int node = 0, end = node_count;
  if (sine2 < 1.0) narrow(normalize(centre), sqrt(1.0 - sine2), sqrt(sine2), node, end);
  ranges[number] = uvec2(node, end);
}
