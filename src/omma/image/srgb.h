// The sRGB transfer function (IEC 61966-2-1), between linear light and what 8-bit files hold. Values are 0 to 1.
#pragma once

#include <algorithm>
#include <cmath>

namespace omma {

/// Clamps to 0..1 first; NaN becomes 0.
inline float srgb_from_linear(float linear) {
  const float x = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

inline float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace omma
