// The parameters that every lens takes in a camera's text, besides its own.
#pragma once

#include <span>

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

}  // namespace omma
