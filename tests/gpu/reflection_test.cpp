// An object that shows what surrounds it, against rays that Embree traces from its middle and from its surface.
#include <fmt/core.h>

#include <cmath>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/oracle/embree_scene.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr int side = 160;  // pixels

/// By technique: one that shades with OpenGL, and the processor alone.
class ReflectionTest : public GpuTest, public ::testing::WithParamInterface<const char*> {
 protected:
  /// A ball in a box 6 m wide whose six walls have six colours, on a grey slab. The ball is object 0.
  static Scene make_room(const glm::dvec3& ball, float roughness, bool with_ball = true) {
    SceneMaker maker;
    Material mirror;
    mirror.metallic = 1.0f;
    mirror.roughness = roughness;
    const int ball_material = maker.add(mirror);
    if (with_ball) maker.place(maker.add(make_ball(0.5f, ball_material)), translation(ball));
    const auto wall = [&](const glm::vec3& color) { return maker.add(unlit(glm::vec4(color, 1.0f))); };
    constexpr float w = 3.0f;
    maker.place(maker.add(make_quad({-w, -w, -w}, {w, -w, -w}, {w, w, -w}, {-w, w, -w}, wall({1, 0, 0}))));
    maker.place(maker.add(make_quad({w, -w, w}, {-w, -w, w}, {-w, w, w}, {w, w, w}, wall({0, 1, 0}))));
    maker.place(maker.add(make_quad({-w, -w, w}, {-w, -w, -w}, {-w, w, -w}, {-w, w, w}, wall({0, 0, 1}))));
    maker.place(maker.add(make_quad({w, -w, -w}, {w, -w, w}, {w, w, w}, {w, w, -w}, wall({1, 1, 0}))));
    maker.place(maker.add(make_quad({-w, w, -w}, {w, w, -w}, {w, w, w}, {-w, w, w}, wall({1, 0, 1}))));
    maker.place(maker.add(make_quad({-w, -w, w}, {w, -w, w}, {w, -w, -w}, {-w, -w, -w}, wall({0, 1, 1}))));
    maker.place(maker.add(make_quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, wall({0.4, 0.4, 0.4}))));
    Light dark;
    dark.color = glm::vec3(0.0f);
    maker.add(dark);
    return maker.finish();
  }

  static RenderOptions reflecting(int object) {
    RenderOptions options{.technique = GetParam(), .samples = 1};
    options.reflect = object;
    return options;
  }
};

const glm::dmat4 pose = look_at_worldFromCamera({0.6, 0.5, 2.2}, {0.0, 0.0, 0.0});

/// The unlit colour that each ray sees; black for none.
std::vector<glm::vec3> colors_along(const Scene& scene, const glm::dvec3& at, const std::vector<glm::vec3>& origins,
                                    const std::vector<glm::vec3>& directions) {
  EmbreeScene trees(scene);
  trees.set_view(translation(at));
  std::vector<RayHit> hits(directions.size());
  trees.nearest(origins, directions, int(directions.size()), Solid::labels, hits);
  std::vector<glm::vec3> colors;
  for (const RayHit& hit : hits) {
    const bool any = std::isfinite(hit.distance);
    colors.push_back(
        any ? glm::vec3(
                  scene.materials[size_t(scene.meshes[size_t(scene.instances[hit.instance].mesh)].material)].base_color)
            : glm::vec3(0.0f));
  }
  return colors;
}

TEST_P(ReflectionTest, OfAMirrorIsWhatRaysFromItsMiddleSee) {
  const glm::dvec3 middle(0.1, -0.2, 0.3);
  const Scene scene = make_room(middle, 0.0f), surroundings = make_room(middle, 0.0f, false);
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{side, side});
  prepare(scene);
  const auto pictures =
      draw(camera, pose, {Channel::color, Channel::position, Channel::normal, Channel::object}, reflecting(0));
  const auto& color = std::get<FloatImage>(pictures.at(Channel::color));
  const auto& place = std::get<FloatImage>(pictures.at(Channel::position));
  const auto& upright = std::get<FloatImage>(pictures.at(Channel::normal));
  const auto& object = std::get<IntImage>(pictures.at(Channel::object));
  std::vector<glm::vec3> from_middle, from_surface, directions, found;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (*object.at(x, y) != 0) continue;
      const glm::vec3 at(place.at(x, y)[0], place.at(x, y)[1], place.at(x, y)[2]);
      const glm::vec3 normal(upright.at(x, y)[0], upright.at(x, y)[1], upright.at(x, y)[2]);
      directions.push_back(glm::reflect(glm::normalize(at - glm::vec3(pose[3])), normal));
      from_middle.emplace_back(0.0f);
      from_surface.push_back(at - glm::vec3(middle));
      found.emplace_back(color.at(x, y)[0], color.at(x, y)[1], color.at(x, y)[2]);
    }
  }
  const auto share_off = [&](const std::vector<glm::vec3>& expected) {
    size_t off = 0;
    for (size_t i = 0; i < found.size(); ++i) {
      const glm::vec3 difference = glm::abs(found[i] - expected[i]);
      off += std::max({difference.x, difference.y, difference.z}) > 0.1f;
    }
    return double(off) / double(found.size());
  };
  const double same = share_off(colors_along(surroundings, middle, from_middle, directions));
  const double parallax = share_off(colors_along(surroundings, middle, from_surface, directions));
  fmt::print("{} pixels: {:.2f}% off rays from the middle, {:.1f}% off rays from the surface\n", found.size(),
             100.0 * same, 100.0 * parallax);
  EXPECT_GT(found.size(), 2000u);
  EXPECT_LT(same, 0.02);     // texels that lie on the edge of two walls
  EXPECT_LT(parallax, 0.2);  // what one centre for the whole object costs in a room this small
}

TEST_P(ReflectionTest, OfARoughSurfaceIsBlurredWithoutASeam) {
  constexpr int wide = 400;  // where the ball faces the camera a pixel turns the reflection by 1.5 degrees at most
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{wide, wide});
  const auto steepest = [&](float roughness) {
    const Scene scene = make_room({0, 0, 0}, roughness);
    prepare(scene);
    const auto pictures = draw(camera, pose, {Channel::color, Channel::object, Channel::normal}, reflecting(0));
    const auto& color = std::get<FloatImage>(pictures.at(Channel::color));
    const auto& object = std::get<IntImage>(pictures.at(Channel::object));
    const auto& upright = std::get<FloatImage>(pictures.at(Channel::normal));
    double most = 0.0;
    for (int y = 0; y < wide; ++y) {
      for (int x = 0; x + 1 < wide; ++x) {
        if (*object.at(x, y) != 0 || *object.at(x + 1, y) != 0) continue;
        // Towards the ball's rim a pixel turns the reflection by more than the lobe is wide.
        const glm::vec3 normal(upright.at(x, y)[0], upright.at(x, y)[1], upright.at(x, y)[2]);
        if (glm::dot(normal, glm::vec3(pose[2])) < 0.6f) continue;
        for (int c = 0; c < 3; ++c) most = std::max(most, double(std::abs(color.at(x, y)[c] - color.at(x + 1, y)[c])));
      }
    }
    return most;
  };
  EXPECT_GT(steepest(0.0f), 0.8);
  EXPECT_LT(steepest(0.7f), 0.25);
}

TEST_P(ReflectionTest, FollowsWhatMovesAndLeavesOthersAlone) {
  Scene scene = make_room({0, 0, 0}, 0.1f);
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{48, 48});
  prepare(scene);
  RenderOptions options = reflecting(0);
  const FloatImage before = draw_color(camera, pose, options);
  EXPECT_EQ(largest_difference(before, draw_color(camera, pose, options)), 0.0);
  scene.instances.back().worldFromObject = translation({0.0, 0.4, 0.0});
  follow(scene);
  const FloatImage after = draw_color(camera, pose, options);
  prepare(scene);
  EXPECT_EQ(largest_difference(after, draw_color(camera, pose, options)), 0.0);
  EXPECT_GT(largest_difference(before, after), 0.1);
  // Walls are unlit and reflect nothing; without the option the ball is as it was.
  options.reflect.reset();
  const FloatImage plain = draw_color(camera, pose, options);
  options.reflect = 3;
  EXPECT_EQ(largest_difference(plain, draw_color(camera, pose, options)), 0.0);
}

TEST_P(ReflectionTest, IsTheSameInExactTechniquesAndWithShadows) {
  const Scene scene = make_room({0, 0, 0}, 0.2f);
  prepare(scene);
  const Camera camera = make_camera("perspective:fov_deg=40", ImageSize{64, 64});
  RenderOptions options = reflecting(0);
  options.shadows = Shadows::cube;
  options.shadow_size = 64;
  const FloatImage truth = draw_color(camera, pose, options);
  for (const char* technique : {"planar", "nonlinear", "visibility:resolve", "visibility:cpu", "piecewise"}) {
    options.technique = technique;
    EXPECT_GT(psnr(truth, draw_color(camera, pose, options)), 35.0) << technique;
  }
}

TEST_P(ReflectionTest, RefusesObjectsThatAreNotThere) {
  const Scene scene = make_room({0, 0, 0}, 0.2f);
  prepare(scene);
  const Camera camera = make_camera("perspective", ImageSize{16, 16});
  EXPECT_THROW(draw_color(camera, pose, reflecting(99)), CommandError);
  RenderOptions options = reflecting(0);
  options.reflection_size = 8;
  EXPECT_THROW(draw_color(camera, pose, options), CommandError);
  options.reflection_size = 1 << 20;
  EXPECT_THROW(draw_color(camera, pose, options), MachineError);
}

INSTANTIATE_TEST_SUITE_P(Techniques, ReflectionTest, ::testing::Values("raycast", "visibility:cpu"),
                         [](const auto& tested) { return test_name(tested.param); });

}  // namespace
}  // namespace omma
