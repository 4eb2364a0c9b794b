// The oracle: Embree finds each ray's triangle, the resolve pass shades it. Exact for every camera that has rays.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry raycast_technique;

}  // namespace omma
