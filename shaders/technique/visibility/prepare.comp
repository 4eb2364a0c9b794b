// As many groups of invocations as a list has work for.
layout(local_size_x = 1) in;

layout(std430, binding = 0) buffer CountBlock { uint counts[]; };
layout(std430, binding = 1) writeonly buffer DispatchBlock { uint dispatch[3]; };
uniform uint task_counter, task_capacity;
uniform uint needed_counter;  // the longest that the list would have been
uniform uint invocations;     // for each of its entries: 1 or 16

void main() {
  uint count = counts[task_counter];
  counts[needed_counter] = max(counts[needed_counter], count);
  uint groups = (min(count, task_capacity) * invocations + 63u) / 64u;
  // In rows, as technique/replication/dispatch.h has them.
  dispatch[0] = min(groups, 32768u);
  dispatch[1] = (groups + 32767u) / 32768u;
  dispatch[2] = 1u;
}
