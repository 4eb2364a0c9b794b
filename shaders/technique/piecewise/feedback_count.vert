// First pass: the pieces of each slot.
#include "technique/piecewise/runs.glsl"
#include "technique/piecewise/feedback_slots.glsl"

layout(std430, binding = 0) buffer LimitedBlock { uint limited; };  // slots that had to wait for the next round

layout(xfb_buffer = 0, xfb_stride = 32) out;
layout(xfb_offset = 0) flat out uint out_total;
layout(xfb_offset = 4) flat out uint out_entries;
layout(xfb_offset = 8) flat out uvec2 out_run_0;
layout(xfb_offset = 16) flat out uvec2 out_run_1;
layout(xfb_offset = 24) flat out uvec2 out_run_2;

void main() {
  uint slot = uint(gl_VertexID);
  uint item;
  int node, end;
  Pyramid pyramid;
  Runs runs;
  runs.total = 0u;
  for (int i = 0; i < MAX_RUNS; ++i) runs.run[i] = uvec2(0u);
  if (find_item(slot, item, node, end) && item_pyramid(item, pyramid)) runs = find_runs(pyramid, node, end);
  uint most = uint(GROWTH) * last_entries_of(slot);
  out_total = runs.total;
  out_entries = clamp(runs.total, 1u, most);
  if (runs.total > most) atomicAdd(limited, 1u);
  out_run_0 = runs.run[0];
  out_run_1 = runs.run[1];
  out_run_2 = runs.run[2];
}
