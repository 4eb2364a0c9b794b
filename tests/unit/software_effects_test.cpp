// Effects without OpenGL. How they look is compared with OpenGL's in tests/gpu/effects_test.cpp.
#include <gtest/gtest.h>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/software/software_renderer.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr Channel color[] = {Channel::color};

Scene make_ball_scene() {
  SceneMaker maker;
  Material grey;
  grey.base_color = {0.4f, 0.4f, 0.4f, 1.0f};
  maker.place(maker.add(make_ball(1.0f, maker.add(grey))), translation({0, 0, -3}));
  return maker.finish();
}

FloatImage draw(const SoftwareRenderer& renderer, std::vector<Effect> effects) {
  const Camera camera = make_camera("equidistant:fov_deg=60", ImageSize{64, 64});
  const SoftwareOptions options{.samples = 1, .effects = std::move(effects)};
  return std::get<FloatImage>(renderer.render(camera, glm::dmat4(1.0), color, options).at(Channel::color));
}

TEST(SoftwareEffectsTest, EveryParameterChangesThePicture) {
  const Scene scene = make_ball_scene();
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  for (const EffectInfo& info : effects()) {
    const FloatImage before = draw(renderer, {make_effect(info.name)});
    EXPECT_NE(before.values, draw(renderer, {}).values) << info.name;
    for (size_t p = 0; p < info.parameters.size(); ++p) {
      Effect changed = make_effect(info.name);
      if (auto* number = std::get_if<float>(&changed.values[p])) *number = 0.7f * *number + 0.1f;
      if (auto* choice = std::get_if<int>(&changed.values[p])) *choice = 1 - *choice;
      if (auto* paint = std::get_if<glm::vec3>(&changed.values[p])) *paint = {0.9f, 0.1f, 0.5f};
      EXPECT_NE(before.values, draw(renderer, {changed}).values) << info.name << " " << info.parameters[p].name;
    }
  }
}

TEST(SoftwareEffectsTest, MoreThanAPictureTakesAreRefused) {
  const Scene scene = make_ball_scene();
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  EXPECT_THROW(draw(renderer, std::vector<Effect>(max_effects + 1, make_effect("contours"))), CommandError);
  EXPECT_THROW(draw(renderer, {make_effect("brick"), make_effect("checker")}), CommandError);
}

}  // namespace
}  // namespace omma
