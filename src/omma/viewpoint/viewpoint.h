// Where to stand, and where to look, when nobody says: before an object, near enough to fill the camera's field; in a
// place, where a person would stand. Decided by the scene's own geometry, the same every time.
#pragma once

#include <glm/glm.hpp>

#include "omma/camera/camera.h"
#include "omma/scene/scene.h"

namespace omma {

/// World metres; the two differ.
struct Viewpoint {
  glm::dvec3 from{0.0, 0.0, 1.0};
  glm::dvec3 to{0.0};
};

/// The view that whoever made the scene chose, where there is one: its first camera's is not asked for. Otherwise that
/// of a standing place (standing_place.h), and without one that of an object in the camera's field (framing.h). The
/// coordinates are rounded to what a person would type, about a thousandth of the scene's size.
///
/// It depends on the scene's current time: ask once for a sequence. For a million triangles it takes some hundredth of
/// a second.
Viewpoint default_viewpoint(const Scene& scene, const Camera& camera);

}  // namespace omma
