// How many pieces each item reaches, or, with WRITE, which: first to know where the replicas of each will lie, then to
// put them there, in the items' order.
#include "technique/replication/slots.glsl"
#include "technique/replication/offsets.glsl"

layout(local_size_x = 64) in;

// Of each slot its first four pieces; where it has more that follow each other without a gap, the first of them with a
// flag. Few triangles have more: the others need not be looked for twice.
const uint CONSECUTIVE = 0x80000000u;
layout(std430, binding = 1) buffer FoundBlock { uvec4 found_pieces[]; };
#ifdef WRITE
layout(std430, binding = 2) writeonly buffer ReplicaBlock { uvec2 replicas[]; };  // item, piece
#endif

#ifdef WRITE
void write(uint slot) {
  uint at = offset_of(slot), end = offset_of(slot + 1u);
  if (at == end) return;
  uvec4 found = found_pieces[slot];
  uint item = item_at(slot);
  if (end - at <= 4u) {
    replicas[at] = uvec2(item, found.x);
    if (at + 1u < end) replicas[at + 1u] = uvec2(item, found.y);
    if (at + 2u < end) replicas[at + 2u] = uvec2(item, found.z);
    if (at + 3u < end) replicas[at + 3u] = uvec2(item, found.w);
    return;
  }
  if ((found.x & CONSECUTIVE) != 0u) {
    for (uint piece = found.x & ~CONSECUTIVE; at < end; ++piece) replicas[at++] = uvec2(item, piece);
    return;
  }
  int node, node_end;
  Pyramid pyramid;
  if (!find_item(slot, item, node, node_end) || !item_pyramid(item, pyramid)) return;
  for (uint piece = next_piece(pyramid, node, node_end); piece != NO_PIECE; piece = next_piece(pyramid, node, node_end)) {
    replicas[at++] = uvec2(item, piece);
  }
}
#else
void count(uint slot) {
  uint item, pieces = 0u, last = 0u;
  uvec4 found = uvec4(0u);
  int node, end;
  Pyramid pyramid;
  if (find_item(slot, item, node, end) && item_pyramid(item, pyramid)) {
    for (uint piece = next_piece(pyramid, node, end); piece != NO_PIECE; piece = next_piece(pyramid, node, end)) {
      found = mix(found, uvec4(piece), equal(uvec4(pieces), uvec4(0u, 1u, 2u, 3u)));
      last = piece;
      ++pieces;
    }
  }
  if (pieces > 4u && last + 1u == found.x + pieces) found.x |= CONSECUTIVE;
  counts[slot] = pieces;
  if (pieces > 0u) found_pieces[slot] = found;
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
