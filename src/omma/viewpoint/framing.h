// An object as a photographer would take it: from the front, to the right and above, and as near as the camera's field
// lets it be seen whole.
#pragma once

#include "omma/viewpoint/viewpoint.h"

namespace omma {

/// The nearest viewpoint from which all vertices, a backdrop's apart (core_bounds.h), lie within 0.85 of the camera's
/// field around its axis, and within 48° of it: through wider cameras one would stand in the object's lap. So the
/// camera is outside the object's convex hull. From another side where single-sided surfaces show their front to that
/// alone. A camera that does not see along its axis is placed as if it saw 30° around it.
Viewpoint frame_object(const Scene& scene, const Camera& camera);

}  // namespace omma
