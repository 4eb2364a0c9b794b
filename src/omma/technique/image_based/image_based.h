// The cube map and its resampling (Trapp, Döllner 2008; Trapp, Lorenz, Döllner 2009): what everybody ships for cameras
// that are not flat, and the baseline of every comparison. The picture is as sharp as the faces' texels and their
// filter let it be; it is not exact.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry image_based_technique;

}  // namespace omma
