// All rays of a camera's image at once.
#pragma once

#include "omma/camera/camera.h"
#include "omma/math/ray.h"

namespace omma {

/// The directions at the centres of the pixels of `region`, or `shift` pixels away from them. The region may reach
/// beyond the image: a lens has rays there too, pieces where they reach that far, a ray map none. In the camera frame,
/// zero where there is no ray. Runs on all cores.
RayMap rays_of(const Camera& camera, const PixelRect& region, const glm::dvec2& shift = glm::dvec2(0.0));

/// Those of the whole image.
RayMap rays_of(const Camera& camera);

}  // namespace omma
