// What the first pass of the feedback variant knows of each slot, this frame and the last.

struct SlotRecord {
  uint total;    // pieces, gaps between runs included
  uint entries;  // in this frame's list of replicas: `total`, at least 1, at most GROWTH times as many as before
  uvec2 run[MAX_RUNS];
};

layout(std430, binding = 6) readonly buffer SlotBlock { SlotRecord slots[]; };
layout(std430, binding = 7) readonly buffer LastSlotBlock { SlotRecord last_slots[]; };
