// How much a run of the tests is to prove.
//
// Grids of cameras and techniques are too large for every day. A run takes the pairs of one day out of seven: each row
// of a grid in every run, each pair within a week. The day is the calendar's, stands in the tests' output, and can be
// asked for (OMMA_PROOF_DAY=0 to 6). OMMA_FULL_PROOF=1 takes all pairs, and thousands or millions of cases where a few
// do for every day.
#pragma once

#include <cstddef>

namespace omma {

bool full_proof();

constexpr size_t proof_days = 7;

/// 0 to 6.
size_t proof_day();

/// Whether the pair is `day`'s. Rows have at least one column each day, and all of them within proof_days.
constexpr bool is_of_day(size_t day, size_t row, size_t column, size_t columns) {
  const size_t turns = columns < proof_days ? columns : proof_days;
  return (row + column) % turns == day % turns;
}

/// Whether this run takes the pair.
bool is_proved_today(size_t row, size_t column, size_t columns);

/// Whether this run takes the row of a long list: a third each day, all within three.
inline bool is_proved_today(size_t row) { return is_proved_today(row, 0, 3); }

}  // namespace omma
