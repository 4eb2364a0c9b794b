// The parts of an image within which a camera's rays are smooth.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "omma/camera/pieces/piece_error.h"
#include "omma/camera/pieces/ray_field.h"

namespace omma {

struct ImagePart {
  std::vector<glm::i64vec2> corners;  ///< a convex polygon on the grid, clockwise as seen
  RayField field;

  /// True for a rectangle along the image's axes, its corners from the top left.
  bool is_rectangle() const;
};

inline glm::dvec2 pixel_of(const glm::i64vec2& place) { return glm::dvec2(place) / static_cast<double>(piece_grid); }

/// Together they cover all that the camera sees of its image.
std::vector<ImagePart> image_parts(const Camera& camera, const SeenPixels& seen);

}  // namespace omma
