// What is asked of a prepared scene.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/pixel_buffer.h"

namespace omma {

/// A camera, where it stands, and where what it sees goes: one eye, one facet, one camera of a rig.
struct Shot {
  Camera camera;
  glm::dmat4 worldFromCamera{1.0};  ///< rigid
  std::vector<Output> outputs;      ///< each channel once, each for the whole image of the camera
};

}  // namespace omma
