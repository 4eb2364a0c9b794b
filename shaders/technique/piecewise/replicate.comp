// How many pieces each item reaches, or, with WRITE, which: first to know where the replicas of each will lie, then to
// put them there, in the items' order.
#include "technique/piecewise/slots.glsl"
#include "technique/piecewise/offsets.glsl"

layout(local_size_x = 64) in;

#ifdef WRITE
layout(std430, binding = 7) writeonly buffer ReplicaBlock { uvec2 replicas[]; };  // item, piece
#endif

void main() {
  uint slot = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (slot >= level_sizes[0]) return;
#ifdef WRITE
  // Within 64 slots, sums that do not grow are of an item without a piece.
  if ((slot & 63u) != 63u && counts[slot] == counts[slot + 1u]) return;
  uint at = offset_of(slot);
#else
  uint count = 0u;
#endif
  uint item;
  int node, end;
  Pyramid pyramid;
  if (find_item(slot, item, node, end) && item_pyramid(item, pyramid)) {
    for (uint piece = next_piece(pyramid, node, end); piece != NO_PIECE; piece = next_piece(pyramid, node, end)) {
#ifdef WRITE
      replicas[at++] = uvec2(item, piece);
#else
      ++count;
#endif
    }
  }
#ifndef WRITE
  counts[slot] = count;
#endif
}
