// The parameters that every lens takes in a camera's text, besides its own.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "omma/camera/lens_model.h"
#include "omma/math/ray.h"

namespace omma {

struct CameraParameterInfo {
  const char* name;
  const char* default_text;
  const char* description;
};

/// In the order in which they are best read.
std::span<const CameraParameterInfo> common_camera_parameters();

/// The smallest field of view accepted, in degrees.
inline constexpr double min_fov_deg = 0.001;

/// The size of an image when nobody asks for one.
inline constexpr ImageSize default_image_size{1600, 1200};

/// The extent that a name stands for, aliases included. Throws CommandError that begins with `what`.
Fit parse_fit(std::string_view what, std::string_view name);

/// Half of an image's extent, in pixels.
double half_extent(Fit fit, const ImageSize& size);

/// Lens::cameraFromLens of `yaw_deg`, `pitch_deg` and `roll_deg`. `degrees` gives each, 0 where the text has none, and
/// refuses what lies beyond -limit to limit.
glm::dmat3 lens_rotation(const std::function<double(const char* key, double limit)>& degrees);

/// What pixel values for an image of `own` size are multiplied by for one of another size but the same shape, up to
/// rounding to whole pixels. Throws CommandError for another shape; `what` names the width.
glm::dvec2 image_scale(std::string_view what, const ImageSize& own, const ImageSize& wanted);

}  // namespace omma
