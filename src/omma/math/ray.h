// A ray and the size of an image: the two things every part of Omma speaks of.
#pragma once

#include <glm/glm.hpp>

namespace omma {

/// A ray has an origin even where every ray shares one: omnidirectional stereo has no single centre.
/// Metres; `direction` is of unit length.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
};

struct ImageSize {
  int width = 0;
  int height = 0;
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// Pixels `x0 <= x < x1`, `y0 <= y < y1`, y down.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

}  // namespace omma
