// As many points as the slot's item has pieces: lines of up to 65 points, at most 64 lines; where that is not enough,
// several pieces to a point.
#include "technique/piecewise/runs.glsl"

layout(vertices = 1) out;

flat in uint vertex_slot[];

patch out uint patch_item;
patch out uint patch_total;
patch out uint patch_share;  // pieces a point
patch out uvec2 patch_grid;  // points along a line, lines
patch out uvec2 patch_runs[MAX_RUNS];

void main() {
  uint item;
  int node, end;
  Pyramid pyramid;
  Runs runs;
  runs.total = 0u;
  if (find_item(vertex_slot[0], item, node, end) && item_pyramid(item, pyramid)) runs = find_runs(pyramid, node, end);
  patch_item = item;
  patch_total = runs.total;
  for (int i = 0; i < MAX_RUNS; ++i) patch_runs[i] = runs.run[i];
  patch_share = (runs.total + 64u * 65u - 1u) / (64u * 65u);
  uint points = patch_share == 0u ? 0u : (runs.total + patch_share - 1u) / patch_share;
  patch_grid.x = clamp(points, 2u, 65u);
  patch_grid.y = (points + patch_grid.x - 1u) / patch_grid.x;
  gl_TessLevelOuter[0] = float(patch_grid.y);  // none where the item reaches no piece
  gl_TessLevelOuter[1] = float(patch_grid.x - 1u);
}
