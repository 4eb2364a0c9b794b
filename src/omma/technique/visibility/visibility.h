// The exact technique for every camera: the camera's own rays, as a tree, find their triangles; the resolve pass shades
// each visible pixel once.
#pragma once

#include "omma/technique/technique.h"

namespace omma {

extern const TechniqueEntry visibility_technique;

/// The variant `gpu`.
std::unique_ptr<Technique> make_gpu_visibility(DrawTools& tools);

}  // namespace omma
