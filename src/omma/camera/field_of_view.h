// How much of the world a camera's image shows, measured from its rays.
#pragma once

#include <optional>

#include "omma/camera/camera.h"

namespace omma {

/// Degrees. Each is measured along a line through the image's centre, out to the last point on either side that has a
/// ray: the angle from the central ray to one end plus the angle to the other. Nothing when the centre has no ray.
struct FieldOfView {
  std::optional<double> horizontal_deg;  ///< along the middle row
  std::optional<double> vertical_deg;    ///< along the middle column
  std::optional<double> diagonal_deg;    ///< from the top left corner to the bottom right one
};

FieldOfView field_of_view(const Camera& camera);

}  // namespace omma
