// How far pictures are moved against each other.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/image/shift.h"

namespace omma {
namespace {

/// Waves of several directions and lengths, moved by `offset`, as a screen would show them.
FloatImage waves(ImageSize size, glm::dvec2 offset, int components) {
  FloatImage image(size, components);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec2 p = glm::dvec2(x, y) - offset;
      const double value = 0.5 + 0.2 * std::sin(0.31 * p.x + 0.1 * p.y) + 0.15 * std::sin(0.47 * p.y - 0.2 * p.x) +
                           0.1 * std::cos(1.1 * p.x) * std::sin(0.9 * p.y);
      for (int c = 0; c < components; ++c) image.at(x, y)[c] = float(value * (1.0 - 0.2 * c));
    }
  }
  return image;
}

TEST(ImageShift, FindsTheOffsetThatAPictureWasMovedBy) {
  for (const glm::dvec2 offset : {glm::dvec2(0.0), glm::dvec2(0.003, -0.002), glm::dvec2(0.2, 0.15),
                                  glm::dvec2(-0.5, 0.5), glm::dvec2(1.0, -2.0), glm::dvec2(-3.3, 2.6)}) {
    for (const int components : {1, 3}) {
      const auto shift =
          image_shift(waves({160, 120}, {}, components), waves({160, 120}, offset, components), Scale::raw);
      ASSERT_TRUE(shift);
      // Observed: 2% for waves as short as six pixels.
      EXPECT_LT(glm::distance(*shift, offset), 1e-4 + 0.03 * glm::length(offset)) << offset.x << ", " << offset.y;
    }
  }
}

TEST(ImageShift, LeavesOutWhatIsNotFinite) {
  FloatImage a = waves({160, 120}, {}, 1), b = waves({160, 120}, {0.2, -0.1}, 1);
  for (int i = 0; i < 40; ++i) *a.at(3 * i, 2 * i) = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 40; ++i) *b.at(2 * i, 3 * i) = std::numeric_limits<float>::quiet_NaN();
  const auto shift = image_shift(a, b, Scale::raw);
  ASSERT_TRUE(shift);
  EXPECT_LT(glm::distance(*shift, glm::dvec2(0.2, -0.1)), 7e-3);
}

TEST(ImageShift, IsNothingWhereNothingTellsIt) {
  EXPECT_FALSE(image_shift(FloatImage({64, 64}, 3, 0.5f), FloatImage({64, 64}, 3, 0.5f), Scale::display));
  FloatImage stripes({64, 64}, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) *stripes.at(x, y) = float(std::sin(0.4 * x));
  }
  EXPECT_FALSE(image_shift(stripes, stripes, Scale::raw));
  EXPECT_FALSE(image_shift(IntImage({64, 64}, 1, 3), IntImage({64, 64}, 1, 3), Scale::raw));
  EXPECT_FALSE(image_shift(waves({2, 2}, {}, 1), waves({2, 2}, {}, 1), Scale::raw));
  EXPECT_THROW(image_shift(waves({8, 8}, {}, 1), waves({8, 9}, {}, 1), Scale::raw), InputError);
}

}  // namespace
}  // namespace omma
