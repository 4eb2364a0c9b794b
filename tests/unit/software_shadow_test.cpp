// Shadows without OpenGL: where they lie, by hand. Against rays from lights they are tested in
// tests/gpu/shadow_test.cpp.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "omma/math/pose.h"
#include "omma/software/software_renderer.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr Channel color[] = {Channel::color};

/// A floor, and a square of two metres one metre above it.
Scene make_table(const Light& light) {
  SceneMaker maker;
  Material paint;
  paint.roughness = 1.0f;
  paint.double_sided = true;
  const int material = maker.add(paint);
  maker.place(maker.add(make_quad({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}, material)));
  maker.place(maker.add(make_quad({-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}, material)));
  maker.add(light);
  return maker.finish();
}

/// Looks straight up at the floor, as nothing else can: from below nothing hides the shadow.
FloatImage draw_floor(const SoftwareRenderer& renderer, Shadows shadows, int samples = 1) {
  SoftwareOptions options{.samples = samples, .shadows = shadows, .shadow_size = 512};
  const glm::dmat4 pose = look_at_worldFromCamera({0.0, 0.9, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
  const Camera camera = make_camera("equidistant:fov_deg=160", ImageSize{128, 128});
  return std::get<FloatImage>(renderer.render(camera, pose, color, options).at(Channel::color));
}

/// Of the floor's pixels those whose light is wrong, where `is_dark(x, z)` says which places the light cannot reach and
/// `is_border` which are too near to tell.
template <typename IsDark, typename IsBorder>
void expect_dark_where(const FloatImage& bright, const FloatImage& shadowed, const IsDark& is_dark,
                       const IsBorder& is_border) {
  const Camera camera = make_camera("equidistant:fov_deg=160", ImageSize{128, 128});
  int dark = 0, lit = 0, wrong = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const auto ray = camera.unproject({x + 0.5, y + 0.5});
      if (!ray || !(bright.at(x, y)[1] > 1e-3f)) continue;
      const double reach = 0.9 / -ray->direction.z;  // the camera looks down, its right is the world's
      const double at_x = reach * ray->direction.x, at_z = -reach * ray->direction.y;
      if (std::abs(at_x) > 7.5 || std::abs(at_z) > 7.5 || is_border(at_x, at_z)) continue;
      const float share = shadowed.at(x, y)[1] / bright.at(x, y)[1];
      (is_dark(at_x, at_z) ? dark : lit) += 1;
      wrong += is_dark(at_x, at_z) ? share > 0.01f : share < 0.99f;
    }
  }
  EXPECT_GT(dark, 200);
  EXPECT_GT(lit, 200);
  EXPECT_EQ(wrong, 0);
}

TEST(SoftwareShadowTest, LieWhereNoLightGets) {
  Light lamp, spot, sun;
  lamp.kind = Light::Kind::point;
  spot.kind = Light::Kind::spot;
  lamp.position = spot.position = {0.0, 3.0, 0.0};
  spot.direction = {0.0, -1.0, 0.0};
  spot.inner_angle = 1.3f;
  spot.outer_angle = 1.4f;
  sun.direction = {0.0, -1.0, 0.0};
  for (Light light : {lamp, spot, sun}) {
    light.color = glm::vec3(50.0f);
    Scene scene = make_table(light);
    scene.ambient = glm::vec3(0.0f);
    LazySceneIndex index(scene);
    SoftwareRenderer renderer(index);
    const FloatImage bright = draw_floor(renderer, Shadows::off);
    // Lamps at three metres cast the square half as large again; the sun is a little wide, but casts it as it is.
    const double half = light.kind == Light::Kind::sun ? 1.0 : 1.5, border = 0.12;
    const auto off = [&](double x, double z) { return std::max(std::abs(x), std::abs(z)) - half; };
    for (const Shadows kind : {Shadows::paraboloid, Shadows::cube}) {
      SCOPED_TRACE(testing::Message() << "light " << int(light.kind) << ", shadows " << int(kind));
      expect_dark_where(
          bright, draw_floor(renderer, kind), [&](double x, double z) { return off(x, z) < 0.0; },
          [&](double x, double z) { return std::abs(off(x, z)) < border; });
    }
  }
}

TEST(SoftwareShadowTest, FollowWhatMovesAndAreGoneWithoutMaps) {
  Light lamp;
  lamp.kind = Light::Kind::point;
  lamp.position = {0.0, 3.0, 0.0};
  lamp.color = glm::vec3(50.0f);
  Scene scene = make_table(lamp);
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const FloatImage bright = draw_floor(renderer, Shadows::off), before = draw_floor(renderer, Shadows::cube);
  EXPECT_EQ(draw_floor(renderer, Shadows::cube).values, before.values);
  EXPECT_NE(before.values, bright.values);
  EXPECT_EQ(draw_floor(renderer, Shadows::off).values, bright.values);
  scene.lights.front().position.x = 1.0;
  const SceneChanges changes{.moved = true, .lights = true};
  index.update(changes);
  renderer.update(changes);
  const FloatImage after = draw_floor(renderer, Shadows::cube);
  EXPECT_NE(after.values, before.values);
  const LazySceneIndex index_anew(scene);
  const SoftwareRenderer anew(index_anew);
  EXPECT_EQ(draw_floor(anew, Shadows::cube).values, after.values);
}

TEST(SoftwareShadowTest, AreTheSameOnAnyNumberOfThreads) {
  Light lamp;
  lamp.kind = Light::Kind::point;
  lamp.position = {0.4, 2.5, 0.1};
  lamp.color = glm::vec3(50.0f);
  const Scene scene = make_table(lamp);
  std::vector<float> first;
  for (const size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    LazySceneIndex index(scene);
    SoftwareRenderer renderer(index);
    const FloatImage picture = draw_floor(renderer, Shadows::paraboloid, 4);
    if (first.empty()) first = picture.values;
    EXPECT_EQ(picture.values, first);
  }
}

}  // namespace
}  // namespace omma
