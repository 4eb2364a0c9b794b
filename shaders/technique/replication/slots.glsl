// Items by slot: a place in a list of clusters, 64 slots each, or, with ITEM_LIST, in a list of items.
#include "technique/replication/cone_tree.glsl"
#include "${COVERAGE}"

#ifdef ITEM_LIST
layout(binding = 20) uniform usamplerBuffer item_texels;
uniform uint item_count;
#else
#include "technique/replication/clusters.glsl"
layout(binding = 25) uniform usamplerBuffer range_texels;  // the nodes that a cluster reaches: first, end
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
  uvec2 range = texelFetch(range_texels, int(slot >> 6)).xy;
  if (range.x >= range.y) return false;
  node = int(range.x);
  end = int(range.y);
  ClusterRecord cluster = cluster_of(slot >> 6);
  item = item_of(cluster.part, cluster.first + (slot & 63u));
  return (slot & 63u) < cluster.count;
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
  bool exists = pyramid_of(corner_position(instance, corner.x), corner_position(instance, corner.y),
                           corner_position(instance, corner.z), part.cull_sign, pyramid);
#ifdef TRIANGLE_FORMS
  if (exists) pyramid.form = form_of(pyramid);
#endif
  return exists;
}
