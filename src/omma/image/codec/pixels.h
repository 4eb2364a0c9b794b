// A picture as its file holds it: numbers that nobody has given a meaning yet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <variant>
#include <vector>

#include "omma/math/ray.h"

namespace omma {

/// What a file's header says.
struct PictureInfo {
  ImageSize size;
  int components = 0;
  int alpha = -1;  ///< which component is alpha; -1: none
};

/// Called before anything of that size is allocated, since a broken header must not be able to ask for all memory.
/// Throws InputError where it is too much.
using Accept = std::function<void(const PictureInfo&)>;

struct Pixels {
  static constexpr int most_components = 4;
  using Samples = std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<uint32_t>, std::vector<float>>;

  PictureInfo info;
  /// Rows from the top, the first `stored()` components of each pixel beside each other.
  Samples samples;

  int stored() const { return std::min(info.components, most_components); }
  size_t count() const { return size_t(info.size.width) * size_t(info.size.height) * size_t(stored()); }
};

/// As 8-bit samples: whole numbers scaled to their type's range, floats clamped to 0..1.
std::vector<uint8_t> to_8_bits(Pixels pixels);

}  // namespace omma
