#include "omma/image/srgb8.h"

#include <array>
#include <bit>
#include <cmath>

#include "omma/image/srgb.h"

namespace omma {
namespace {

uint8_t exact(float linear) { return static_cast<uint8_t>(std::lround(255.0f * srgb_from_linear(linear))); }

/// The bits of floats from `darkest` to 1 rise with their values. They are cut into steps of equal exponent and first
/// seven bits, each so narrow that the result changes at most once within.
class Table {
 public:
  Table() {
    for (uint32_t i = 0; i < steps_.size(); ++i) {
      const uint32_t first = first_bits + (i << step_bits), last = first + (1U << step_bits) - 1;
      const uint8_t lowest = exact(std::bit_cast<float>(first));
      steps_[i] = {lowest, lowest == exact(std::bit_cast<float>(last)) ? last + 1 : change_between(first, last)};
    }
  }

  uint8_t operator()(float linear) const {
    const float clamped = linear > darkest ? std::min(linear, 1.0f) : darkest;  // NaN is dark
    const auto bits = std::bit_cast<uint32_t>(clamped);
    const Step& step = steps_[(bits - first_bits) >> step_bits];
    return static_cast<uint8_t>(step.lowest + (bits >= step.change));
  }

 private:
  struct Step {
    uint32_t lowest = 0;
    uint32_t change = 0;  ///< the bits from which on it is one more
  };

  static constexpr float darkest = 0x1p-13F;  // still 0: the first change is at 0.5 / 255 / 12.92
  static constexpr uint32_t first_bits = std::bit_cast<uint32_t>(darkest), last_bits = std::bit_cast<uint32_t>(1.0f);
  static constexpr uint32_t step_bits = 16;

  static uint32_t change_between(uint32_t below, uint32_t above) {
    const uint8_t lowest = exact(std::bit_cast<float>(below));
    while (above - below > 1) {
      const uint32_t middle = below + (above - below) / 2;
      (exact(std::bit_cast<float>(middle)) == lowest ? below : above) = middle;
    }
    return above;
  }

  std::array<Step, ((last_bits - first_bits) >> step_bits) + 1> steps_;
};

}  // namespace

void srgb8_from_linear(const float* from, uint8_t* to, size_t count) {
  static const Table table;
  for (size_t i = 0; i < count; ++i) to[i] = table(from[i]);
}

}  // namespace omma
