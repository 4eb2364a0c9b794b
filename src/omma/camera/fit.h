// One camera as another model: the parameters whose pixels are nearest, and how near they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

/// How far the pixels of two cameras are apart: each pixel's ray of the one, projected by the other.
struct Residual {
  size_t points = 0;  ///< pixels compared, on a grid over the image, its edges included
  size_t lost = 0;    ///< of those, how many have a ray that the other camera does not see
  double mean_px = 0.0;
  double p95_px = 0.0;  ///< 95 of 100 are nearer
  double max_px = 0.0;
  glm::dvec2 max_at{0.0};  ///< the pixel of the largest
};

/// Over the rays within `max_angle` radians of the way the lens looks. Throws CommandError when `other` is a ray map,
/// InputError when no pixel of `camera` has a ray there.
Residual residual_between(const Camera& camera, const Camera& other, double max_angle = 3.14159265358979323846);

struct CameraFit {
  Camera camera;
  Residual residual;   ///< over the part that was fitted
  double angle = 0.0;  ///< radians from the way the lens looks up to which it was fitted
  double part = 1.0;   ///< that part of the pixels with a ray
};

/// Non-linear least squares over the image of `camera`, a ray map too: focal lengths, principal point and the
/// parameters named in `free`, or all of them; the others keep their defaults. A camera of that model is returned as it
/// is unless some of its parameters are to be left out. Where the model cannot hold all that the camera sees (some of
/// it lies beyond its formula, or farther off than a twentieth of the image's diagonal), it is fitted to the widest
/// cone around the axis that it can hold. Throws CommandError for a model without a focal length, for a parameter that
/// the model does not have, and when nothing of the camera can be seen with that model.
CameraFit fit_camera(const Camera& camera, const LensModel& model,
                     const std::optional<std::vector<std::string>>& free = std::nullopt);

}  // namespace omma
