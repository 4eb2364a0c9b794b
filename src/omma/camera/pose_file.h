// Lists of camera poses, a trajectory to render.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "omma/base/limits.h"

namespace omma {

struct NamedPose {
  std::string name;            ///< the image's name, or the time as it is written
  glm::dmat4 worldFromCamera;  ///< rigid; the camera looks along -z with +y up
  std::optional<double> time;  ///< seconds, where the file says
};

/// The poses of a file, in its order. Two formats are known by what the first line of data holds:
///
/// - TUM trajectory, a line `time tx ty tz qx qy qz qw` each: the position of the camera and its rotation, from the
///   camera's optical frame (x right, y down, z forward) to the world, in metres and seconds.
/// - COLMAP images.txt, two lines each: `IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME`, from the world to the optical
///   frame, then that image's points, which are skipped.
///
/// In both, lines that begin with # are comments. Cameras are turned into Omma's frame; the world stays the file's own.
/// Throws InputError with file and line for anything else, for a file without poses, and for quaternions whose length
/// is not 1 within a hundredth, and for more poses than the limit.
std::vector<NamedPose> load_poses(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace omma
