// Which shadow maps lights get: every direction a light shines in lies in one of its maps, with room for a filter.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "omma/shading/shadow_layers.h"

namespace omma {
namespace {

constexpr int size = 128;
const Bounds somewhere{{-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}};

std::vector<ShadowLayer> layers_of(const Light& light, Shadows kind) {
  return plan_shadow_layers({&light, 1}, {&somewhere, 1}, kind, size);
}

Light lamp(Light::Kind kind, float outer_angle = 0.5f) {
  Light light;
  light.kind = kind;
  light.position = {3.0, 4.0, 5.0};
  light.direction = {1.0, -2.0, 0.5};
  light.outer_angle = outer_angle;
  return light;
}

/// The largest distance from its map's nearest border that a direction has, over all maps of a light; texels.
double room(const std::vector<ShadowLayer>& layers, const glm::dvec3& direction) {
  double most = -1.0;
  for (const ShadowLayer& layer : layers) {
    const auto at = layer.camera.project(glm::transpose(glm::dmat3(layer.worldFromMap)) * direction);
    if (!at) continue;
    const glm::dvec2 inner = glm::min(*at, double(size) - *at);
    double left = std::min(inner.x, inner.y);
    // A paraboloid's map is a circle.
    if (!layer.flat()) left = 0.5 * size - glm::distance(*at, glm::dvec2(0.5 * size));
    most = std::max(most, left);
  }
  return most;
}

TEST(ShadowLayers, ShowEveryDirectionOfALampWithRoomForTheFilter) {
  size_t tested = 0;
  for (const Shadows kind : {Shadows::paraboloid, Shadows::cube}) {
    for (const Light& light :
         {lamp(Light::Kind::point), lamp(Light::Kind::spot, 0.001f), lamp(Light::Kind::spot, 0.5f),
          lamp(Light::Kind::spot, 1.2f), lamp(Light::Kind::spot, 1.57f), lamp(Light::Kind::spot, 2.5f)}) {
      const std::vector<ShadowLayer> layers = layers_of(light, kind);
      const bool spot = light.kind == Light::Kind::spot;
      for (int i = 0; i < 4000; ++i) {
        const double y = 1.0 - (i + 0.5) / 2000.0, angle = 2.399963 * i, r = std::sqrt(1.0 - y * y);
        const glm::dvec3 direction(r * std::cos(angle), y, r * std::sin(angle));
        const double from_axis = std::acos(glm::dot(direction, glm::normalize(light.direction)));
        if (spot && from_axis > light.outer_angle) continue;
        EXPECT_GT(room(layers, direction), 3.9) << light.outer_angle;
        ++tested;
      }
      for (const ShadowLayer& layer : layers) EXPECT_EQ(glm::dvec3(layer.worldFromMap[3]), light.position);
    }
  }
  EXPECT_GT(tested, 20000u);
}

TEST(ShadowLayers, AreAsManyAsTheLightNeeds) {
  EXPECT_EQ(layers_of(lamp(Light::Kind::point), Shadows::off).size(), 0u);
  EXPECT_EQ(layers_of(lamp(Light::Kind::point), Shadows::paraboloid).size(), 2u);
  EXPECT_EQ(layers_of(lamp(Light::Kind::point), Shadows::cube).size(), 6u);
  EXPECT_EQ(layers_of(lamp(Light::Kind::spot, 1.5f), Shadows::paraboloid).size(), 1u);
  EXPECT_EQ(layers_of(lamp(Light::Kind::spot, 1.6f), Shadows::paraboloid).size(), 2u);
  EXPECT_EQ(layers_of(lamp(Light::Kind::spot, 0.7f), Shadows::cube).size(), 1u);
  EXPECT_GT(layers_of(lamp(Light::Kind::spot, 0.9f), Shadows::cube).size(), 2u);
  EXPECT_LE(layers_of(lamp(Light::Kind::spot, 0.9f), Shadows::cube).size(), 5u);
  EXPECT_EQ(layers_of(lamp(Light::Kind::sun), Shadows::paraboloid).size(), 1u);
}

TEST(ShadowLayers, OfASunShowWhatCastsShadowsFromAfar) {
  Light sun = lamp(Light::Kind::sun);
  // A plain of a kilometre, a thing that reaches below it, and a tower.
  const Bounds boxes[] = {{{-500, 0, -500}, {500, 0, 500}}, {{0, -0.1, 0}, {1, 1, 1}}, {{3, 0, 3}, {8, 30, 9}}};
  const std::vector<ShadowLayer> layers = plan_shadow_layers({&sun, 1}, boxes, Shadows::cube, size);
  ASSERT_EQ(layers.size(), 1u);
  const glm::dvec3 centre(layers[0].worldFromMap[3]);
  for (int corner = 0; corner < 8; ++corner) {
    const Bounds& tower = boxes[2];
    const glm::dvec3 at(corner & 1 ? tower.max.x : tower.min.x, corner & 2 ? tower.max.y : tower.min.y,
                        corner & 4 ? tower.max.z : tower.min.z);
    EXPECT_GT(room(layers, at - centre), 3.9);
    const double off = std::acos(glm::dot(glm::normalize(at - centre), glm::normalize(sun.direction)));
    EXPECT_LT(glm::degrees(off), 0.3);
  }
  // The plain did not count.
  const double width = glm::distance(centre, glm::dvec3(4.0, 15.0, 4.5)) * size / layers[0].camera.lens()->focal.x;
  EXPECT_LT(width, 60.0);
}

}  // namespace
}  // namespace omma
