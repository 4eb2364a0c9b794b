// The six faces of a cube around the camera, and which parts of them an image needs.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "omma/camera/camera.h"

namespace omma {

/// Rows are right, down and ahead of each face in the camera frame, so that a direction d lands on face f at
/// (x/z, y/z) with (x, y, z) = faceFromCamera[f] * d. Order +X -X +Y -Y +Z -Z, as in technique/resample.frag.
extern const std::array<glm::dmat3, 6> faceFromCamera;

/// Tangents seen on a face: -1 to 1 is the face itself. Empty when `min.x > max.x`.
struct FaceWindow {
  glm::dvec2 min{1e9}, max{-1e9};
  bool empty() const { return min.x > max.x; }
};

/// The smallest window of each face that holds every ray of `region`, whichever way a pass shifts its samples.
std::array<FaceWindow, 6> seen_windows(const Camera& camera, const PixelRect& region);

}  // namespace omma
