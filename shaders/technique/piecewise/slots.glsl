// Items by slot: a place in a list of clusters, 64 slots each, or, with ITEM_LIST, in a list of items.
#include "technique/piecewise/coverage.glsl"

#ifdef ITEM_LIST
layout(std430, binding = 5) readonly buffer ItemBlock { uint items[]; };
uniform uint item_count;
#else
// Up to 64 triangles of a part, tested as one before each for itself.
struct ClusterRecord {
  vec4 sphere;      // centre and radius, object frame
  uvec4 triangles;  // part, first, count
};
layout(std430, binding = 5) readonly buffer ClusterBlock { ClusterRecord clusters[]; };
uniform uint cluster_count;
#endif

// The item of a slot and the nodes that it can reach. False where there is none, or none is reached.
bool find_item(uint slot, out uint item, out int node, out int end) {
  node = 0;
  end = node_count;
#ifdef ITEM_LIST
  item = slot < item_count ? items[slot] : 0u;
  return slot < item_count;
#else
  item = 0u;
  if (slot >= 64u * cluster_count) return false;
  ClusterRecord cluster = clusters[slot >> 6];
  uint triangle = slot & 63u;
  item = item_of(cluster.triangles.x, cluster.triangles.y + triangle);
  InstanceRecord instance = instances[parts[cluster.triangles.x].instance];
  vec3 centre = to_camera(instance, cluster.sphere.xyz);
  // No direction is stretched more than all three together.
  vec3 r0 = instance.cameraFromObject[0].xyz, r1 = instance.cameraFromObject[1].xyz, r2 = instance.cameraFromObject[2].xyz;
  float radius = cluster.sphere.w * sqrt(dot(r0, r0) + dot(r1, r1) + dot(r2, r2));
  float sine2 = radius * radius / dot(centre, centre);
  if (sine2 < 1.0) narrow(normalize(centre), sqrt(1.0 - sine2), sqrt(sine2), node, end);
  return triangle < cluster.triangles.z && node < end;
#endif
}

// The item of a slot that find_item has found before.
uint item_at(uint slot) {
#ifdef ITEM_LIST
  return items[slot];
#else
  ClusterRecord cluster = clusters[slot >> 6];
  return item_of(cluster.triangles.x, cluster.triangles.y + (slot & 63u));
#endif
}

bool item_pyramid(uint item, out Pyramid pyramid) {
  InstanceRecord instance;
  uvec3 corner = item_corners(item, instance);
  return pyramid_of(corner_position(instance, corner.x), corner_position(instance, corner.y),
                    corner_position(instance, corner.z), parts[item_part(item)].cull_sign, pyramid);
}
