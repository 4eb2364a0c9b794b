#include "omma/image/srgb8.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "omma/image/srgb.h"

namespace omma {
namespace {

uint8_t exact(float linear) { return static_cast<uint8_t>(std::lround(255.0f * srgb_from_linear(linear))); }

/// The bits of floats from `darkest` to 1 rise with their values. They are cut into steps of equal exponent and first
/// seven bits, each so narrow that the result changes at most once within. A step's entry is its lowest result and,
/// behind the point, what the rest of the bits has to add to reach the change: their sum is the result.
class Table {
 public:
  Table() {
    for (uint32_t i = 0; i < entries_.size(); ++i) {
      const uint32_t first = first_bits + (i << step_bits), end = first + (1U << step_bits);
      const uint8_t lowest = exact(std::bit_cast<float>(first));
      const uint32_t change = exact(std::bit_cast<float>(end - 1)) == lowest ? end : change_between(first, end - 1);
      entries_[i] = (uint32_t{lowest} << step_bits) + (end - change);
    }
  }

  void operator()(const float* from, uint8_t* to, size_t count) const {
    // In two loops, the first of which a processor does for many numbers at once.
    constexpr size_t block = 256;
    std::array<uint32_t, block> bits;
    for (size_t begin = 0; begin < count; begin += block) {
      const size_t size = std::min(block, count - begin);
      for (size_t i = 0; i < size; ++i) bits[i] = bits_above_darkest(from[begin + i]);
      for (size_t i = 0; i < size; ++i) {
        const uint32_t rest = bits[i] & ((1U << step_bits) - 1);
        to[begin + i] = static_cast<uint8_t>((entries_[bits[i] >> step_bits] + rest) >> step_bits);
      }
    }
  }

 private:
  static uint32_t bits_above_darkest(float linear) {
    const float lit = linear > darkest ? linear : darkest;  // NaN is dark
    return std::bit_cast<uint32_t>(lit < 1.0f ? lit : 1.0f) - first_bits;
  }

  static constexpr float darkest = 0x1p-13F;  // still 0: the first change is at 0.5 / 255 / 12.92
  static constexpr uint32_t first_bits = std::bit_cast<uint32_t>(darkest), last_bits = std::bit_cast<uint32_t>(1.0f);
  static constexpr uint32_t step_bits = 16;
  static_assert((first_bits & ((1U << step_bits) - 1)) == 0);

  static uint32_t change_between(uint32_t below, uint32_t above) {
    const uint8_t lowest = exact(std::bit_cast<float>(below));
    while (above - below > 1) {
      const uint32_t middle = below + (above - below) / 2;
      (exact(std::bit_cast<float>(middle)) == lowest ? below : above) = middle;
    }
    return above;
  }

  std::array<uint32_t, ((last_bits - first_bits) >> step_bits) + 1> entries_;
};

}  // namespace

void srgb8_from_linear(const float* from, uint8_t* to, size_t count) {
  static const Table table;
  table(from, to, count);
}

void srgb8_row(const float* from, size_t pixels, int components, uint8_t* to) {
  if (components == 3) return srgb8_from_linear(from, to, 3 * pixels);
  constexpr size_t at_once = 64;
  uint8_t encoded[3 * at_once];
  for (size_t first = 0; first < pixels; first += at_once) {
    const size_t count = std::min(at_once, pixels - first);
    srgb8_from_linear(from + 3 * first, encoded, 3 * count);
    for (size_t i = 0; i < count; ++i) {
      uint8_t* pixel = to + 4 * (first + i);
      for (int c = 0; c < 3; ++c) pixel[c] = encoded[3 * i + size_t(c)];
      pixel[3] = 255;
    }
  }
}

}  // namespace omma
