// What a run of the tests leaves to another day is proved within a week.
#include "tests/proof.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace omma {
namespace {

TEST(Proof, TakesEachRowEveryDayAndEachPairWithinAWeek) {
  for (size_t columns = 1; columns <= 20; ++columns) {
    constexpr size_t rows = 60;
    std::set<std::pair<size_t, size_t>> of_week;
    size_t of_busiest_day = 0;
    for (size_t day = 0; day < proof_days; ++day) {
      size_t of_day = 0;
      for (size_t row = 0; row < rows; ++row) {
        size_t of_row = 0;
        for (size_t column = 0; column < columns; ++column) {
          if (!is_of_day(day, row, column, columns)) continue;
          of_week.emplace(row, column);
          ++of_row;
        }
        EXPECT_GE(of_row, 1u) << "row " << row << " of " << columns << " columns on day " << day;
        of_day += of_row;
      }
      of_busiest_day = std::max(of_busiest_day, of_day);
    }
    EXPECT_EQ(of_week.size(), rows * columns) << columns << " columns";
    // A day's work is spread evenly.
    EXPECT_LE(of_busiest_day, rows * ((columns + proof_days - 1) / proof_days));
  }
}

}  // namespace
}  // namespace omma
