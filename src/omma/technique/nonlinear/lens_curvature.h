// How much a lens bends the edges of triangles, depending on where they are: bounds of the derivatives of its
// projection along great circles, from which it follows how far a curved edge lies from the straight one between its
// ends.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

/// Along any great circle, an angle s (radians) to a pixel p(s), around some direction. An edge of angle a then turns
/// by at most bend * a / speed in the image, and no farther is p' off its chord's direction: p leaves the chord by at
/// most (bend + change * bend * a / speed) * a^2 / 8 pixels.
struct Curvature {
  float bend = 0.0f;    ///< |p''| across p', at most
  float change = 0.0f;  ///< |p''|, at most; infinite where the projection is not smooth or not all is seen
  float speed = 0.0f;   ///< |p'|, at least

  float turn(float angle) const { return bend * angle / speed; }
  float deviation_px(float angle) const;
};

/// A table over directions for triangles of up to a few sizes. Any lens, measured on its formulae.
class LensCurvature {
 public:
  /// Cells along a side of a cube's face.
  static constexpr int cells_a_side = 24;
  static constexpr int levels = 5;
  /// Of all directions within this angle (radians) of one, the table of a level knows the bounds.
  static constexpr double reach(int level) { return (1 << level) / 48.0; }

  explicit LensCurvature(const Lens& lens);

  /// The same lens, seeing as far as its formula goes.
  static Lens without_limit(Lens lens);

  /// Of all that is within `angle` of a direction of the camera frame, whatever its length.
  Curvature around(const glm::dvec3& direction, double angle) const;

  /// Level after level, face after face (+X, -X, +Y, -Y, +Z, -Z), in rows.
  const std::vector<Curvature>& cells() const { return cells_; }

 private:
  std::vector<Curvature> cells_;
};

}  // namespace omma
