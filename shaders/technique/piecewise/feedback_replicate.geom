// Second pass: an entry of last frame's list to those of this frame's: every entry of a slot that had m of them takes
// each m-th number of the new ones, so that no entry needs to know of another.
#include "technique/piecewise/feedback_slots.glsl"

layout(points) in;
layout(points, max_vertices = GROWTH) out;

flat in uvec2 vertex_entry[];
layout(xfb_buffer = 0, xfb_offset = 0) flat out uvec2 out_entry;

void main() {
  uint slot = vertex_entry[0].x;
  uint step = last_entries_of(slot), entries = entries_of(slot);
  for (uint number = vertex_entry[0].y; number < entries; number += step) {
    out_entry = uvec2(slot, number);
    EmitVertex();
    EndPrimitive();
  }
}
