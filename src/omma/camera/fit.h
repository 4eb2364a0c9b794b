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

/// Throws CommandError when `other` is a ray map, InputError when no pixel of `camera` has a ray.
Residual residual_between(const Camera& camera, const Camera& other);

struct CameraFit {
  Camera camera;
  Residual residual;
};

/// Non-linear least squares over the image of `camera`, a ray map too: focal lengths, principal point and the
/// parameters named in `free`, or all of them; the others keep their defaults. A camera of that model is returned as it
/// is unless some of its parameters are to be left out. Throws CommandError for a model without a focal length, for a
/// parameter that the model does not have, and when nothing of the camera can be seen with that model.
CameraFit fit_camera(const Camera& camera, const LensModel& model,
                     const std::optional<std::vector<std::string>>& free = std::nullopt);

}  // namespace omma
