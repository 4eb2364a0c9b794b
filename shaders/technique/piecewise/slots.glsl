// Items by slot: a place in a list of clusters, 64 slots each, or, with ITEM_LIST, in a list of items.
#include "technique/piecewise/coverage.glsl"

#ifdef ITEM_LIST
layout(binding = 20) uniform usamplerBuffer item_texels;
uniform uint item_count;
#else
// Up to 64 triangles of a part, tested as one before each for itself.
struct ClusterRecord {
  vec4 sphere;       // centre and radius, object frame
  uint part, first, count;
};
layout(binding = 20) uniform usamplerBuffer cluster_texels;
uniform uint cluster_count;

ClusterRecord cluster_of(uint number) {
  uvec4 triangles = texelFetch(cluster_texels, 2 * int(number) + 1);
  return ClusterRecord(uintBitsToFloat(texelFetch(cluster_texels, 2 * int(number))), triangles.x, triangles.y, triangles.z);
}
#endif

// The item of a slot and the nodes that it can reach. False where there is none, or none is reached.
bool find_item(uint slot, out uint item, out int node, out int end) {
  node = 0;
  end = node_count;
#ifdef ITEM_LIST
  item = slot < item_count ? texelFetch(item_texels, int(slot)).x : 0u;
  return slot < item_count;
#else
  item = 0u;
  if (slot >= 64u * cluster_count) return false;
  ClusterRecord cluster = cluster_of(slot >> 6);
  uint triangle = slot & 63u;
  item = item_of(cluster.part, cluster.first + triangle);
  InstanceRecord instance = instance_of(part_of(cluster.part).instance);
  vec3 centre = to_camera(instance, cluster.sphere.xyz);
  // No direction is stretched more than all three together.
  vec3 r0 = instance.cameraFromObject[0].xyz, r1 = instance.cameraFromObject[1].xyz, r2 = instance.cameraFromObject[2].xyz;
  float radius = cluster.sphere.w * sqrt(dot(r0, r0) + dot(r1, r1) + dot(r2, r2));
  float sine2 = radius * radius / dot(centre, centre);
  if (sine2 < 1.0) narrow(normalize(centre), sqrt(1.0 - sine2), sqrt(sine2), node, end);
  return triangle < cluster.count && node < end;
#endif
}

// The item of a slot that find_item has found before.
uint item_at(uint slot) {
#ifdef ITEM_LIST
  return texelFetch(item_texels, int(slot)).x;
#else
  ClusterRecord cluster = cluster_of(slot >> 6);
  return item_of(cluster.part, cluster.first + (slot & 63u));
#endif
}

bool item_pyramid(uint item, out Pyramid pyramid) {
  PartRecord part = part_of(item_part(item));
  InstanceRecord instance = instance_of(part.instance);
  uvec3 corner = item_corners(item, part, instance);
  return pyramid_of(corner_position(instance, corner.x), corner_position(instance, corner.y),
                    corner_position(instance, corner.z), part.cull_sign, pyramid);
}
