// The rays of a small square of an image as polynomials of the place in it: twenty evaluations of a camera's formula
// instead of thousands, whatever the formula is and however many samples a pixel has.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

/// Direction in the camera frame at (u, v), both within -1 and 1: the sum of term[j][i] u^i v^j. The place in the image
/// is middle + half_side (u, v), pixels.
///
/// What it gives is as long as 1 and where the camera's formula is, up to what PatchFitter says.
struct RayPatch {
  static constexpr int terms = 4;
  glm::dvec2 middle{0.0};
  double half_side = 0.0;
  std::array<std::array<glm::dvec3, terms>, terms> term{};

  glm::dvec3 direction(const glm::dvec2& pixel) const;
};

/// Makes the patches of a camera.
class PatchFitter {
 public:
  /// The camera must outlive this object.
  explicit PatchFitter(const Camera& camera);

  /// Where a patch is compared with the formula, it is off by these parts of the distance of two rays a pixel apart at
  /// most; single precision's last digit is never asked for.
  static constexpr double tolerance = 1e-4;

  /// Nothing where the camera does not see all of the square, where it is not smooth, or bends more than a patch does.
  /// The square has `half_side` pixels to each side of its middle.
  std::optional<RayPatch> around(const glm::dvec2& middle, double half_side) const;

  /// True only where no point of the square has a ray; of a point, half_side is 0.
  bool is_blank(const glm::dvec2& middle, double half_side) const;

 private:
  bool is_smooth(const glm::dvec2& low, const glm::dvec2& high) const;
  /// True where a hole may lie between all the places that a patch asks the formula for: of directions within `reach`,
  /// radians, of `ahead`.
  bool may_hide_a_hole(const glm::dvec3& ahead, double reach) const;

  const Camera& camera_;
  /// Convex polygons of the image, clockwise as seen, within which the lens is smooth; none where it is everywhere.
  std::vector<std::vector<glm::dvec2>> parts_;
  /// Beyond this radius of the lens's plane nothing is seen.
  std::optional<double> last_radius_;
  /// The lens may see nothing around its centre.
  bool has_hole_in_middle_ = false;
};

}  // namespace omma
