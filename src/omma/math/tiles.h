// A large image in parts that fit.
#pragma once

#include <algorithm>
#include <vector>

#include "omma/math/ray.h"

namespace omma {

/// Squares of `side` pixels, smaller at the right and bottom border, rows from the top.
inline std::vector<PixelRect> tiles_of(ImageSize size, int side) {
  std::vector<PixelRect> tiles;
  for (int y = 0; y < size.height; y += side) {
    for (int x = 0; x < size.width; x += side) {
      tiles.push_back({x, y, std::min(x + side, size.width), std::min(y + side, size.height)});
    }
  }
  return tiles;
}

}  // namespace omma
