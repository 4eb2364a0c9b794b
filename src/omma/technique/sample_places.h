// Where a driver's samples lie within a pixel.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace omma {

/// From the pixel's top left corner, in 1/256 px. As many as the driver gives for the asked number, at least as many;
/// for one sample the pixel's centre.
std::vector<glm::ivec2> sample_places(int samples);

}  // namespace omma
