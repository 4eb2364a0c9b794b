// Linear light as 8-bit sRGB, fast: a picture has 200 million numbers, and a power takes 20 ns.
#pragma once

#include <cstddef>
#include <cstdint>

namespace omma {

/// `to[i] = round(255 * srgb_from_linear(from[i]))`, to the last bit.
void srgb8_from_linear(const float* from, uint8_t* to, size_t count);

/// A row of pixels of three numbers as pixels of three bytes, or of four, the last of them 255.
void srgb8_row(const float* from, size_t pixels, int components, uint8_t* to);

}  // namespace omma
