// Adaptive subdivision: triangles are split where a lens bends their edges, and the parts drawn with straight ones.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry subdivision_technique;

}  // namespace omma
