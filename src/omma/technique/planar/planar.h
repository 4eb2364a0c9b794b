// The perspective camera as every GPU draws it: one matrix, straight edges. Exact, and what all curved ways are
// measured against.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

/// True for the perspective lens.
bool planar_draws(const Camera& camera);

/// Clip space of a flat image: `x` and `y` are the tangents seen at the image's two edges in a frame with x right, y
/// down, z ahead; depth is near_depth / z.
glm::dmat4 clip_from_flat_frame(glm::dvec2 x, glm::dvec2 y);

extern const TechniqueEntry planar_technique;

}  // namespace omma
