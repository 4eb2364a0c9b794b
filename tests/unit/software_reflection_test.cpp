// Reflections without OpenGL: what a mirror shows, by hand. How rough ones look is compared with OpenGL's in
// tests/gpu/reflection_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/software/software_renderer.h"
#include "omma/visibility/find_blocks.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr Channel color[] = {Channel::color};
constexpr float half_room = 3.0f;
const glm::dmat4 pose = look_at_worldFromCamera({0.6, 0.5, 2.2}, {0.0, 0.0, 0.0});

/// Of the wall that lies towards -X, +X, -Y, +Y, -Z, +Z.
glm::vec3 wall_color(int wall) { return glm::vec3((wall + 1) & 1, (wall + 1) >> 1 & 1, (wall + 1) >> 2 & 1); }

/// Two balls of one mesh, objects 0 and 1, in a dark room with six bright walls. They are seen from inside, too: one
/// that were not left out of its own maps would see nothing else.
Scene make_room(const glm::dvec3& ball, float roughness) {
  SceneMaker maker;
  Material mirror;
  mirror.metallic = 1.0f;
  mirror.roughness = roughness;
  mirror.double_sided = true;
  const int mesh = maker.add(make_ball(0.5f, maker.add(mirror)));
  maker.place(mesh, translation(ball));
  maker.place(mesh, translation({-1.4, 0.0, 0.0}));
  for (int wall = 0; wall < 6; ++wall) {
    const int axis = wall / 2;
    glm::vec3 middle(0.0f), u(0.0f), v(0.0f);
    middle[axis] = wall % 2 ? half_room : -half_room;
    u[(axis + 1) % 3] = half_room;
    v[(axis + 2) % 3] = half_room;
    Material paint = unlit(glm::vec4(wall_color(wall), 1.0f));
    paint.double_sided = true;
    maker.place(maker.add(make_quad(middle - u - v, middle + u - v, middle + u + v, middle - u + v, maker.add(paint))));
  }
  Light dark;
  dark.color = glm::vec3(0.0f);
  maker.add(dark);
  return maker.finish();
}

/// What a ray from the middle of an empty room sees.
glm::vec3 color_along(const glm::dvec3& from, const glm::dvec3& direction) {
  double nearest = 1e30;
  int wall = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double t = ((direction[axis] > 0.0 ? half_room : -half_room) - from[axis]) / direction[axis];
    if (!(t < nearest)) continue;
    nearest = t;
    wall = 2 * axis + (direction[axis] > 0.0);
  }
  return wall_color(wall);
}

glm::dvec3 value(const std::map<Channel, Image>& pictures, Channel channel, int x, int y) {
  const float* at = std::get<FloatImage>(pictures.at(channel)).at(x, y);
  return {at[0], at[1], at[2]};
}
int object(const std::map<Channel, Image>& pictures, int x, int y) {
  return *std::get<IntImage>(pictures.at(Channel::object)).at(x, y);
}

FloatImage draw(const SoftwareRenderer& renderer, const Camera& camera, const SoftwareOptions& options) {
  return std::get<FloatImage>(renderer.render(camera, pose, color, options).at(Channel::color));
}

float largest_difference(const FloatImage& a, const FloatImage& b) {
  EXPECT_EQ(a.values.size(), b.values.size());
  float most = 0.0f;
  for (size_t i = 0; i < a.values.size(); ++i) most = std::max(most, std::abs(a.values[i] - b.values[i]));
  return most;
}

TEST(SoftwareReflectionTest, AMirrorShowsWhatItsMiddleSeesAndNotItself) {
  const glm::dvec3 middle(0.1, -0.2, 0.3);
  const Scene scene = make_room(middle, 0.0f);
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const Camera camera = make_camera("equidistant:fov_deg=120", ImageSize{96, 96});
  constexpr Channel wanted[] = {Channel::color, Channel::position, Channel::normal, Channel::object};
  const auto plain = renderer.render(camera, pose, wanted, {.samples = 1});
  const auto mirrored = renderer.render(camera, pose, wanted, {.samples = 1, .reflect = 0, .reflection_size = 256});
  size_t seen = 0, off = 0, others = 0, neighbours = 0;
  for (int y = 0; y < camera.size().height; ++y) {
    for (int x = 0; x < camera.size().width; ++x) {
      const glm::dvec3 now = value(mirrored, Channel::color, x, y);
      if (object(mirrored, x, y) != 0) {
        // The other ball, of the same material and mesh, is as it was.
        EXPECT_LT(glm::distance(now, value(plain, Channel::color, x, y)), 1e-6);
        others += object(mirrored, x, y) == 1;
        continue;
      }
      const glm::dvec3 view = glm::normalize(value(mirrored, Channel::position, x, y) - glm::dvec3(pose[3]));
      const glm::dvec3 along = glm::reflect(view, value(mirrored, Channel::normal, x, y));
      ++seen;
      // The ball beside it, of no light at all, as the mirror sees it.
      const glm::dvec3 towards = glm::dvec3(-1.4, 0.0, 0.0) - middle;
      const double beside = glm::length(glm::cross(along, towards));
      if (glm::dot(along, towards) > 0.0 && beside < 0.55) {
        neighbours += beside < 0.45 && glm::length(now) < 0.7;
        continue;
      }
      off += glm::distance(now, glm::dvec3(color_along(middle, along))) > 0.1;
    }
  }
  EXPECT_GT(seen, 300u);
  EXPECT_GT(others, 100u);
  EXPECT_GT(neighbours, 3u);
  // Texels that lie on the edge of two walls. Observed: 3.6%.
  EXPECT_LT(off, seen / 15);
}

TEST(SoftwareReflectionTest, FollowsWhatMoves) {
  Scene scene = make_room({0, 0, 0}, 0.3f);
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{48, 48});
  const SoftwareOptions options{.samples = 2, .reflect = 0, .reflection_size = 64};
  const FloatImage before = draw(renderer, camera, options);
  EXPECT_EQ(draw(renderer, camera, options).values, before.values);
  scene.instances.back().worldFromObject = translation({0.0, 0.0, -1.0});
  EXPECT_EQ(draw(renderer, camera, options).values, before.values);
  const SceneChanges changes{.moved = true, .lights = true};
  index.update(changes);
  renderer.update(changes);
  const FloatImage after = draw(renderer, camera, options);
  EXPECT_GT(largest_difference(before, after), 0.05f);
  const LazySceneIndex index_anew(scene);
  const SoftwareRenderer anew(index_anew);
  EXPECT_EQ(draw(anew, camera, options).values, after.values);
}

TEST(SoftwareReflectionTest, MapsAreThoseOfTheOptions) {
  Scene scene = make_room({0, 0, 0}, 0.1f);
  scene.instances.resize(2);  // no walls
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{32, 32});
  SoftwareOptions options{.samples = 1, .background = glm::vec3(0.5f), .reflect = 0, .reflection_size = 64};
  const FloatImage grey = draw(renderer, camera, options);
  EXPECT_NEAR(grey.at(16, 16)[0], 0.5f, 0.02f);
  options.background = glm::vec3(1.0f, 0.0f, 0.0f);
  EXPECT_NEAR(draw(renderer, camera, options).at(16, 16)[1], 0.0f, 0.02f);
  options.background = glm::vec3(0.5f);
  options.reflect = 1;
  EXPECT_LT(draw(renderer, camera, options).at(16, 16)[0], 0.2f);
  options.reflect = 0;
  EXPECT_EQ(draw(renderer, camera, options).values, grey.values);
}

TEST(SoftwareReflectionTest, EverySimdTargetDrawsThePicture) {
  // In the room's middle, texels' rays would meet its corners within rounding.
  const Scene scene = make_room({0.1, -0.2, 0.3}, 0.3f);
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{48, 48});
  const SoftwareOptions options{.samples = 1, .reflect = 0, .reflection_size = 64};
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const FloatImage best = draw(renderer, camera, options);
  for (const std::string& target : simd_targets()) {
    use_simd_target(target);
    const LazySceneIndex index_anew(scene);
    const SoftwareRenderer anew(index_anew);
    const FloatImage other = draw(anew, camera, options);
    double sum = 0.0;
    for (size_t i = 0; i < other.values.size(); ++i) sum += std::abs(other.values[i] - best.values[i]);
    EXPECT_LT(sum / double(other.values.size()), 1e-4) << target;
  }
  use_simd_target("");
}

TEST(SoftwareReflectionTest, RefusesObjectsAndMapsThatCannotBe) {
  const Scene scene = make_room({0, 0, 0}, 0.3f);
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const Camera camera = make_camera("perspective", ImageSize{16, 16});
  EXPECT_THROW(draw(renderer, camera, {.reflect = 99}), CommandError);
  EXPECT_THROW(draw(renderer, camera, {.reflect = 0, .reflection_size = 1 << 20}), MachineError);
  EXPECT_THROW(plan_reflection_layers(scene, -1, 64), CommandError);
  EXPECT_THROW(plan_reflection_layers(Scene{}, 0, 64), CommandError);
}

TEST(SurroundingsTest, EveryLevelHasTheLightOfTheFirst) {
  const Scene scene = make_room({0, 0, 0}, 0.3f);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0.0f, 4.0f);
  for (const int size : {16, 37, 64, 101}) {
    const ReflectionLayers layers = plan_reflection_layers(scene, 0, size);
    std::array<FloatImage, 2> maps{FloatImage(layers.camera.size(), 3), FloatImage(layers.camera.size(), 3)};
    for (FloatImage& map : maps) {
      for (float& each : map.values) each = uniform(random);
    }
    const Surroundings surroundings(layers, maps);
    EXPECT_EQ(surroundings.levels, layers.levels);
    for (size_t side = 0; side < 2; ++side) {
      const double first = std::accumulate(maps[side].values.begin(), maps[side].values.end(), 0.0) / (size * size);
      for (int l = 0; l < surroundings.levels; ++l) {
        const int extent = size >> l;
        const auto begin = surroundings.texels[side].begin() + 3 * surroundings.first[size_t(l)];
        const auto end = begin + 3 * extent * extent;
        EXPECT_NEAR(std::accumulate(begin, end, 0.0) / (extent * extent), first, 1e-4) << size << ", level " << l;
        EXPECT_EQ(end == surroundings.texels[side].end(), l + 1 == surroundings.levels);
      }
    }
  }
}

}  // namespace
}  // namespace omma
