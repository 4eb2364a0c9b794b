// Piecewise perspective projections (Lorenz, Döllner 2009): triangles are replicated into the perspective pieces of the
// image that they reach and drawn there by ordinary rasterization, without resampling and with unchanged shaders.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry piecewise_technique;

}  // namespace omma
