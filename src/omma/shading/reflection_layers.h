// Which maps let an object reflect what surrounds it: what a camera in its middle sees of either half of the world.
#pragma once

#include <glm/glm.hpp>

#include "omma/camera/camera.h"
#include "omma/scene/scene.h"

namespace omma {

struct ReflectionLayers {
  /// `stereographic` (a paraboloid): each map sees 20 degrees of the other's half, so that blurred texels need not know
  /// what is beyond it.
  Camera camera;
  /// Rigid, at the middle of the object's bounds. Both stand upright; the first looks along the world's -Z, the second
  /// along +Z.
  glm::dmat4 worldFromMap[2];
  /// Mipmap levels that stay within what a map sees, the finest included.
  int levels;
};

/// Two square maps of `size` texels along a side, 16 or more. Throws CommandError when the scene has no such object.
ReflectionLayers plan_reflection_layers(const Scene& scene, int object, int size);

}  // namespace omma
