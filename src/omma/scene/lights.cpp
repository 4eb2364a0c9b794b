#include "omma/scene/lights.h"

#include <cmath>

namespace omma {

LightRecord light_record(const Light& light, const glm::dmat4& cameraFromWorld) {
  const glm::dvec3 direction = glm::normalize(glm::dmat3(cameraFromWorld) * light.direction);
  return {glm::vec4(glm::vec3(cameraFromWorld * glm::dvec4(light.position, 1.0)), light.range),
          glm::vec4(glm::vec3(direction), float(static_cast<int>(light.kind))), glm::vec4(light.color, 0.0f),
          glm::vec4(std::cos(light.inner_angle), std::cos(light.outer_angle), 0.0f, 0.0f)};
}

std::vector<Light> lights_of(const Scene& scene) {
  if (!scene.lights.empty()) return scene.lights;
  Light sun;
  sun.direction = glm::normalize(glm::dvec3(-0.5, -1.0, -0.35));
  sun.color = glm::vec3(2.8f, 2.7f, 2.5f);
  return {sun};
}

}  // namespace omma
