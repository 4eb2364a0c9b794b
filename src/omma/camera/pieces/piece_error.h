// How far a piece is from the camera it stands for.
#pragma once

#include <array>
#include <span>

#include "omma/camera/pieces/approximate.h"
#include "omma/camera/pieces/ray_field.h"

namespace omma {

/// Which pixels of an image the camera sees, for asking whether a polygon covers any.
class SeenPixels {
 public:
  explicit SeenPixels(const Camera& camera);

  /// False only when nothing of the convex polygon is seen: pixels next to it count.
  bool any_in(std::span<const glm::dvec2> corners) const;
  /// Centres of seen pixels within the polygon: the first and the last of each row, and up to `most` spread evenly.
  std::vector<glm::dvec2> within(std::span<const glm::dvec2> corners, size_t most) const;
  /// The rectangle around all of them, pixels; empty where there is none.
  PixelRect bounds() const;

 private:
  int step_;                 ///< pixels a side of what is asked once
  ImageSize squares_;        ///< of that size
  std::vector<int> before_;  ///< in each row, how many seen ones lie before a column
};

}  // namespace omma
