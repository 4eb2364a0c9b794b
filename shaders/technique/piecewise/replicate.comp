// How many pieces each item reaches, or, with WRITE, which: first to know where the replicas of each will lie, then to
// put them there, in the items' order.
#include "technique/piecewise/slots.glsl"
#include "technique/piecewise/offsets.glsl"

layout(local_size_x = 64) in;

// Of each slot its first piece, and whether the others follow it without a gap, as most do: those need not be looked for
// twice.
const uint CONSECUTIVE = 0x80000000u;
layout(std430, binding = 1) buffer FirstBlock { uint first_pieces[]; };
#ifdef WRITE
layout(std430, binding = 2) writeonly buffer ReplicaBlock { uvec2 replicas[]; };  // item, piece
#endif

#ifdef WRITE
void write(uint slot) {
  // Within 64 slots, sums that do not grow are of an item without a piece.
  bool last_of_sum = (slot & 63u) == 63u;
  if (!last_of_sum && counts[slot] == counts[slot + 1u]) return;
  uint at = offset_of(slot);
  uint first = first_pieces[slot];
  if ((first & CONSECUTIVE) != 0u) {
    uint end = offset_of(slot + 1u), item = item_at(slot);
    for (uint piece = first & ~CONSECUTIVE; at < end; ++piece) replicas[at++] = uvec2(item, piece);
    return;
  }
  uint item;
  int node, end;
  Pyramid pyramid;
  if (!find_item(slot, item, node, end) || !item_pyramid(item, pyramid)) return;
  for (uint piece = next_piece(pyramid, node, end); piece != NO_PIECE; piece = next_piece(pyramid, node, end)) {
    replicas[at++] = uvec2(item, piece);
  }
}
#else
void count(uint slot) {
  uint item, pieces = 0u, first = 0u, last = 0u;
  int node, end;
  Pyramid pyramid;
  if (find_item(slot, item, node, end) && item_pyramid(item, pyramid)) {
    for (uint piece = next_piece(pyramid, node, end); piece != NO_PIECE; piece = next_piece(pyramid, node, end)) {
      first = pieces == 0u ? piece : first;
      last = piece;
      ++pieces;
    }
  }
  counts[slot] = pieces;
  first_pieces[slot] = first | (last + 1u == first + pieces ? CONSECUTIVE : 0u);
}
#endif

void main() {
  uint slot = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (slot >= level_sizes[0]) return;
#ifdef WRITE
  write(slot);
#else
  count(slot);
#endif
}
