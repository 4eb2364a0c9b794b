// The groups of a batch against the nodes of the topmost level.
#include "technique/visibility/bodies.glsl"
#include "technique/visibility/distance.glsl"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

uniform uint first_pair, pair_end;  // group times nodes at the top plus node
uniform uint node_first, node_count;
uniform int batch;  // -1: all of them
uniform uint solid;

layout(binding = 24) uniform usamplerBuffer batch_texels;

const uint OPAQUE = 0u, LABELS = 1u, BLENDED = 2u;

bool is_in_batch(uint step) {
  if (batch < 0) return true;
  uint first = batch > 0 ? texelFetch(batch_texels, batch - 1).x : 0u;
  return step >= first && step < texelFetch(batch_texels, batch).x;
}

void main() {
  uint pair = first_pair + invocation();
  if (pair >= pair_end) return;
  uint group = pair / node_count, node = node_first + pair % node_count;
  uvec2 placed = texelFetch(placed_group_texels, int(group)).xy;
  Placement placement = placement_of(placed.x);
  if (solid != LABELS && placement.blended != (solid == BLENDED)) return;
  Box box = group_of(placed.y);
  append_if(is_in_batch(distance_step(box, placement)) && may_see(box, placement, node_of(node)), uvec2(group, node));
}
