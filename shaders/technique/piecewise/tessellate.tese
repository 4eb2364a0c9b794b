// A point of a patch to the pieces it stands for.
#include "technique/piecewise/runs.glsl"

layout(isolines, equal_spacing, point_mode) in;

patch in uint patch_item;
patch in uint patch_total;
patch in uint patch_share;
patch in uvec2 patch_grid;
patch in uvec2 patch_runs[MAX_RUNS];

flat out uint point_item;
flat out uint point_count;
flat out uint point_pieces[PIECES_A_POINT];

void main() {
  uint column = uint(round(gl_TessCoord.x * float(patch_grid.x - 1u)));
  uint row = uint(round(gl_TessCoord.y * float(patch_grid.y)));
  uint first = (row * patch_grid.x + column) * patch_share;
  point_item = patch_item;
  point_count = first < patch_total ? min(patch_share, patch_total - first) : 0u;
  for (uint i = 0u; i < uint(PIECES_A_POINT); ++i) {
    point_pieces[i] = i < point_count ? piece_of_run(patch_runs, first + i) : 0u;
  }
}
