// Vertices projected, edges straight: the naive baseline. Right where triangles are small in the image; triangles with
// a vertex that the lens does not see, or that cross a seam of the image, are left out.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry vertex_technique;

}  // namespace omma
