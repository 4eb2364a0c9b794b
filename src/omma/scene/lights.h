// A scene's lights as shaders see them: in the camera frame, as four vectors each.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "omma/scene/scene.h"

namespace omma {

/// As in shaders/common/frame.glsl.
struct LightRecord {
  glm::vec4 position;   ///< camera frame, metres; w: range in metres, 0 none
  glm::vec4 direction;  ///< camera frame, unit length, the way the light travels; w: Light::Kind
  glm::vec4 color;      ///< suns: irradiance; others: radiant intensity
  glm::vec4 cone;       ///< cosines of a spot's inner and outer angle; first and number of its shadow maps, here 0
};

LightRecord light_record(const Light& light, const glm::dmat4& cameraFromWorld);

/// The scene's, or a sun where neither the file nor the scene has a light.
std::vector<Light> lights_of(const Scene& scene);

}  // namespace omma
