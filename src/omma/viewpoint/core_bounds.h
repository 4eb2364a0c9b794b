// The part of a scene that its maker took trouble over, without the ground and the sky around it.
#pragma once

#include "omma/scene/scene.h"

namespace omma {

/// The scene's bounds, world; where all but a few of its triangles lie in a quarter of them or less, as a house on an
/// endless plane or under a dome of sky, the bounds of those.
Bounds core_bounds(const Scene& scene);

}  // namespace omma
