// Triangles with curved edges, each drawn once through the camera's own projection (Gascuel, Holzschuch, Fournier,
// Péroche 2008): a shape that bounds a triangle in the image is rasterized, and every fragment's ray decides.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry nonlinear_technique;

}  // namespace omma
