// Cameras symmetric about their axis, given by r(θ) or θ(r) as any function that rises.
#pragma once

#include <initializer_list>
#include <optional>

#include "omma/camera/deformation/deformed_image.h"
#include "omma/camera/deformation/rising_function.h"

namespace omma {

/// r in units of the focal length, θ in radians.
struct RadialForm {
  RisingFunction function;
  bool radius_of_angle;  ///< it is r(θ), else θ(r)

  std::optional<double> angle(double radius) const {
    return radius_of_angle ? function.inverse(radius) : function(radius);
  }
  std::optional<double> radius(double angle) const {
    return radius_of_angle ? function(angle) : function.inverse(angle);
  }
  /// Radians from the axis up to which the camera sees.
  double max_angle() const;
};

/// The keys that make_radial_camera reads.
inline constexpr std::initializer_list<const char*> radial_keys = {
    "fov_deg", "fit", "f", "fx", "fy", "cx", "cy", "width", "height", "yaw_deg", "pitch_deg", "roll_deg"};

/// Scales the plane to the image: by `f` (or `fx` and `fy`), or so that `fov_deg`, or else r = 1, spans the extent of
/// `fit` (shorter).
Camera make_radial_camera(const DeformationText& text, const RadialForm& form, std::optional<ImageSize> size);

}  // namespace omma
