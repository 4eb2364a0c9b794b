// Whether a scene is a place that one stands in, a building or a street, or an object that one looks at.
#pragma once

#include <optional>

#include "omma/viewpoint/viewpoint.h"

namespace omma {

/// Where a person would stand: on a floor that is level around, with free air above, walls or houses about. There, the
/// mean of two shares is 0.6 and more, of all directions and of the level ones: the share that meets a surface from its
/// front. Hardly any meets a back, as they do within a solid. Where three hundredths of the ground plan are such spots
/// the scene is a place; of the spots one that is well enclosed, has room, and lies on the level on which most of them
/// are is taken. The look goes level along the longest free way. Nothing for other scenes, and none for a scene that is
/// smaller than a person or so tall, over 70 m, that the grid's cells are taller than one.
///
/// Eyes are 1.7 m above the floor, lower under a low ceiling. In the open they are no higher than 0.6 of what is free
/// around in most spots: a town may have a unit that is no metre. Beyond 20 km nothing is taken for metres.
std::optional<Viewpoint> find_standing_place(const Scene& scene);

}  // namespace omma
