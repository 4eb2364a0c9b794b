// Prefix sums in levels: 64 values of a level become one of the next, until one is left, the total. All levels lie in
// one buffer; scan.comp turns the values of each 64 into what comes before them.
layout(std430, binding = 0) buffer CountBlock { uint counts[]; };

const int MAX_LEVELS = 7;
uniform uint level_first[MAX_LEVELS];  // in the buffer
uniform uint level_sizes[MAX_LEVELS];
uniform int level_count;

uint total_count() { return counts[level_first[level_count - 1]]; }

// Of all values before `slot`; the total where `slot` is their number.
uint offset_of(uint slot) {
  if (slot >= level_sizes[0]) return total_count();
  uint sum = 0u;
  for (int level = 0; level + 1 < level_count; ++level) {
    sum += counts[level_first[level] + slot];
    slot >>= 6;
  }
  return sum;
}
