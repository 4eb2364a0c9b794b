// What the first pass of the feedback variant knows of each slot, this frame and the last.

struct SlotRecord {
  uint total;    // pieces, gaps between runs included
  uint entries;  // in the list of replicas: `total`, at least 1, at most GROWTH times as many as a round before
  uvec2 run[3];
};

layout(binding = 22) uniform usamplerBuffer slot_texels;
layout(binding = 23) uniform usamplerBuffer last_slot_texels;

SlotRecord slot_of(uint number) {
  uvec4 first = texelFetch(slot_texels, 2 * int(number)), second = texelFetch(slot_texels, 2 * int(number) + 1);
  return SlotRecord(first.x, first.y, uvec2[3](first.zw, second.xy, second.zw));
}

uint entries_of(uint slot) { return texelFetch(slot_texels, 2 * int(slot)).y; }
uint last_entries_of(uint slot) { return texelFetch(last_slot_texels, 2 * int(slot)).y; }
