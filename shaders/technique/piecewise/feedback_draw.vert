// Third pass: an entry of the list to its piece.
#include "technique/piecewise/runs.glsl"
#include "technique/piecewise/feedback_slots.glsl"

layout(location = 0) in uvec2 in_entry;  // slot, number

flat out uint point_item;
flat out uint point_count;
flat out uint point_pieces[PIECES_A_POINT];

void main() {
  SlotRecord record = slot_of(in_entry.x);
  point_item = item_at(in_entry.x);
  point_count = in_entry.y < record.total ? 1u : 0u;
  point_pieces[0] = point_count == 0u ? 0u : piece_of_run(record.run, in_entry.y);
}
