// The pieces that an item reaches as runs of numbers, for stages that cannot keep a list: pieces near each other have
// numbers near each other. What is left when runs run out goes into the last one, gaps included.
#include "technique/piecewise/coverage.glsl"
#include "technique/replication/slots.glsl"

struct Runs {
  uint total;  // pieces, gaps included
  uvec2 run[MAX_RUNS];  // first piece, count
};

Runs find_runs(Pyramid pyramid, int node, int end) {
  Runs runs;
  runs.total = 0u;
  for (int i = 0; i < MAX_RUNS; ++i) runs.run[i] = uvec2(0u);
  int last = -1;
  for (uint piece = next_piece(pyramid, node, end); piece != NO_PIECE; piece = next_piece(pyramid, node, end)) {
    if (last < 0 || (piece > runs.run[last].x + runs.run[last].y && last + 1 < MAX_RUNS)) {
      runs.run[++last] = uvec2(piece, 0u);
    }
    runs.run[last].y = piece + 1u - runs.run[last].x;
  }
  for (int i = 0; i < MAX_RUNS; ++i) runs.total += runs.run[i].y;
  return runs;
}

uint piece_of_run(uvec2 run[MAX_RUNS], uint number) {
  for (int i = 0; i < MAX_RUNS; ++i) {
    if (number < run[i].y) return run[i].x + number;
    number -= run[i].y;
  }
  return NO_PIECE;
}
