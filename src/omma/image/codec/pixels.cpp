#include "omma/image/codec/pixels.h"

#include <cmath>

namespace omma {
namespace {

uint8_t to_8_bits(uint16_t value) { return static_cast<uint8_t>((value * 255U + 32767U) / 65535U); }

uint8_t to_8_bits(float value) {
  const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;  // NaN is 0
  return static_cast<uint8_t>(std::lround(255.0f * clamped));
}

uint8_t to_8_bits(uint32_t value) { return static_cast<uint8_t>(std::lround(255.0 * value / 4294967295.0)); }

}  // namespace

SampleVector<uint8_t> to_8_bits(Pixels pixels) {
  return std::visit(
      []<typename T>(SampleVector<T>& samples) {
        if constexpr (std::is_same_v<T, uint8_t>) {
          return std::move(samples);
        } else {
          SampleVector<uint8_t> bytes(samples.size());
          std::transform(samples.begin(), samples.end(), bytes.begin(), [](T value) { return to_8_bits(value); });
          return bytes;
        }
      },
      pixels.samples);
}

}  // namespace omma
