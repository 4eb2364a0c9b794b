// Objects of a scene as people name them.
#pragma once

#include <string_view>

#include "omma/scene/scene.h"

namespace omma {

/// The object of a text: its number, as the channel `object` has it, or the name of its node. Throws CommandError with
/// the nearest name when there is none, and with the numbers when several have the name.
int find_object(const Scene& scene, std::string_view text);

/// World bounds of an object's instances.
Bounds object_bounds(const Scene& scene, int object);

}  // namespace omma
