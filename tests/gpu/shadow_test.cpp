// Shadows by maps of what a light sees, against rays from the light: Embree says which point each light reaches.
#include <fmt/core.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/oracle/embree_scene.h"
#include "omma/shading/shadow_layers.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr int map_size = 1024;
constexpr int side = 140;  // of pictures, pixels

/// Which points a light reaches, by rays along its own way: what a camera there sees from behind stops nothing.
class ShadowRays {
 public:
  ShadowRays(const Scene& scene, const Light& light) : light_(light), trees_(scene) {
    centre_ = light.kind == Light::Kind::sun ? scene.bounds().center() : light.position;
    reach_ = glm::length(scene.bounds().extent());
    trees_.set_view(glm::translate(glm::dmat4(1.0), centre_));
  }

  /// For each world point. What lies within 1e-4 of the way before it is the point's own surface.
  std::vector<bool> reach(const std::vector<glm::dvec3>& points) const {
    std::vector<glm::vec3> origins, directions;
    std::vector<float> lengths;
    for (const glm::dvec3& point : points) {
      const bool sun = light_.kind == Light::Kind::sun;
      const glm::dvec3 origin = sun ? point - centre_ - reach_ * glm::normalize(light_.direction) : glm::dvec3(0.0);
      const glm::dvec3 way = point - centre_ - origin;
      origins.emplace_back(origin);
      directions.emplace_back(glm::normalize(way));
      lengths.push_back(float(glm::length(way)));
    }
    std::vector<RayHit> hits(points.size());
    trees_.nearest(origins, directions, int(points.size()), Solid::labels, hits);
    std::vector<bool> reached;
    for (size_t i = 0; i < hits.size(); ++i) reached.push_back(hits[i].distance >= lengths[i] * (1.0f - 1e-4f));
    return reached;
  }

 private:
  Light light_;
  EmbreeScene trees_;
  glm::dvec3 centre_;
  double reach_;
};

struct ShadowVerdict {
  size_t points = 0, shadowed = 0;
  size_t wrong = 0;                   ///< beyond half the light on the wrong side
  size_t inner = 0, inner_wrong = 0;  ///< where rays to points around, two texels away, all agree
  size_t inner_grey = 0;              ///< neither all nor none of the light
  double share() const { return double(wrong) / double(points); }
  double inner_share() const { return double(inner_wrong) / double(inner); }
};

/// By technique: those that shade with OpenGL, and the processor alone.
class ShadowTest : public GpuTest, public ::testing::WithParamInterface<const char*> {
 protected:
  /// The scene under one light alone, whose colour is white.
  static Scene under(Scene scene, Light light) {
    light.color = glm::vec3(100.0f);
    scene.lights = {light};
    scene.ambient = glm::vec3(0.0f);
    for (Material& material : scene.materials) material.emissive = glm::vec3(0.0f);
    return scene;
  }

  static ShadowVerdict judge(const Scene& scene, const glm::dmat4& pose, Shadows kind, int size = map_size) {
    const Camera camera = make_camera("equidistant:fov_deg=200", ImageSize{side, side});
    RenderOptions options{.technique = GetParam(), .samples = 1, .shadow_size = size};
    prepare(scene);
    const auto plain = draw(camera, pose, {Channel::color, Channel::position, Channel::normal}, options);
    options.shadows = kind;
    const FloatImage shadowed = draw_color(camera, pose, options);
    const auto& bright = std::get<FloatImage>(plain.at(Channel::color));
    const auto& place = std::get<FloatImage>(plain.at(Channel::position));
    const auto& upright = std::get<FloatImage>(plain.at(Channel::normal));
    const Light& light = scene.lights.front();
    const ShadowRays rays(scene, light);
    std::vector<glm::dvec3> points;
    std::vector<double> shares;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const glm::dvec3 at(place.at(x, y)[0], place.at(x, y)[1], place.at(x, y)[2]);
        const glm::dvec3 normal(upright.at(x, y)[0], upright.at(x, y)[1], upright.at(x, y)[2]);
        if (!std::isfinite(at.x) || !(bright.at(x, y)[1] > 1e-2f)) continue;
        const bool sun = light.kind == Light::Kind::sun;
        const double texel = sun ? texel_of_sun(scene, size) : 4.0 / size * glm::distance(at, light.position);
        const glm::dvec3 along =
            2.0 * texel *
            glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
        const glm::dvec3 other = glm::cross(normal, along);
        for (const glm::dvec3& offset : {glm::dvec3(0.0), along, -along, other, -other}) points.push_back(at + offset);
        shares.push_back(shadowed.at(x, y)[1] / bright.at(x, y)[1]);
      }
    }
    const std::vector<bool> reached = rays.reach(points);
    ShadowVerdict verdict;
    for (size_t i = 0; i < shares.size(); ++i) {
      const bool lit = reached[5 * i];
      int same = 0;
      for (size_t k = 1; k < 5; ++k) same += reached[5 * i + k] == lit;
      const bool wrong = (shares[i] > 0.5) != lit;
      ++verdict.points;
      verdict.shadowed += !lit;
      verdict.wrong += wrong;
      verdict.inner += same == 4;
      verdict.inner_wrong += same == 4 && wrong;
      verdict.inner_grey += same == 4 && std::min(shares[i], 1.0 - shares[i]) > 0.02;
    }
    return verdict;
  }

  static double texel_of_sun(const Scene& scene, int size) {
    const auto layers = plan_shadow_layers(scene.lights, boxes_of_triangles(scene), Shadows::cube, size);
    const Lens& lens = *layers.front().camera.lens();
    return glm::distance(glm::dvec3(layers.front().worldFromMap[3]), scene.default_to) / lens.focal.x;
  }
};

struct ShadowCase {
  std::string name;
  Scene scene;
  double share;  ///< share of points on the wrong side, at most; observed: half of it or less
};

TEST_P(ShadowTest, AgreeWithRaysFromTheLight) {
  std::vector<ShadowCase> cases;
  const Scene room = load_scene("room"), temple = load_scene("temple"), city = load_scene("city");
  cases.push_back({"room, lamp", under(room, room.lights.front()), 0.002});
  cases.push_back({"temple, sun", under(temple, temple.lights.front()), 0.004});
  cases.push_back({"city, sun", under(city, city.lights.front()), 0.06});  // texels of 0.3 m
  Light spot;
  spot.kind = Light::Kind::spot;
  spot.position = {12.0, 9.0, 30.0};
  spot.direction = {-0.6, -0.5, -1.0};
  spot.outer_angle = 1.2f;
  spot.inner_angle = 1.0f;
  cases.push_back({"temple, spot", under(temple, spot), 0.015});
  for (const ShadowCase& shown : cases) {
    for (const Shadows kind : {Shadows::paraboloid, Shadows::cube}) {
      const ShadowVerdict verdict = judge(shown.scene, default_pose(shown.scene), kind);
      fmt::print("{}, {}: {} points, {:.1f}% in shadow; wrong {:.3f}%, away from edges {:.4f}%\n", shown.name,
                 kind == Shadows::cube ? "cube" : "paraboloid", verdict.points,
                 100.0 * double(verdict.shadowed) / double(verdict.points), 100.0 * verdict.share(),
                 100.0 * verdict.inner_share());
      EXPECT_GT(verdict.points, 1500u);
      EXPECT_GT(verdict.shadowed, 25u);
      EXPECT_LT(verdict.share(), shown.share);
      EXPECT_LT(verdict.inner_share(), 0.004);
    }
  }
}

/// A wall of small squares three metres before a lamp, and a ball between them at the height of the seam of the lamp's
/// two paraboloids, which is level with it.
Scene make_seam() {
  SceneMaker maker;
  Material paint;
  paint.roughness = 1.0f;
  const int material = maker.add(paint);
  Mesh wall = make_pane(-3.0f, 2.0f, material);
  wall.positions.clear(), wall.normals.clear(), wall.uvs.clear(), wall.triangles.clear();
  constexpr unsigned squares = 40;
  for (unsigned j = 0; j <= squares; ++j) {
    for (unsigned i = 0; i <= squares; ++i) {
      wall.positions.emplace_back(-2.0f + 0.1f * float(i), -2.0f + 0.1f * float(j), -3.0f);
      wall.normals.emplace_back(0.0f, 0.0f, 1.0f);
      wall.uvs.emplace_back(0.0f);
      if (i == squares || j == squares) continue;
      const unsigned at = j * (squares + 1) + i;
      wall.triangles.emplace_back(at, at + 1, at + squares + 2);
      wall.triangles.emplace_back(at, at + squares + 2, at + squares + 1);
    }
  }
  maker.place(maker.add(wall));
  maker.place(maker.add(make_ball(0.2f, material)), translation({0.4, 0.05, -1.5}));
  Light lamp;
  lamp.kind = Light::Kind::point;
  lamp.color = glm::vec3(100.0f);
  maker.add(lamp);
  return maker.finish();
}

TEST_P(ShadowTest, ShowNoLineWhereMapsMeet) {
  const Scene scene = make_seam();
  const glm::dmat4 pose = look_at_worldFromCamera({0.0, 1.5, -0.5}, {0.0, 0.0, -3.0});
  for (const Shadows kind : {Shadows::paraboloid, Shadows::cube}) {
    for (const int size : {64, 512}) {
      const ShadowVerdict verdict = judge(scene, pose, kind, size);
      fmt::print("{} texels: {} points, {} in shadow; wrong {:.3f}%, away from edges {}\n", size, verdict.points,
                 verdict.shadowed, 100.0 * verdict.share(), verdict.inner_wrong);
      EXPECT_GT(verdict.inner, 1900u);
      EXPECT_GT(verdict.shadowed, 50u);
      EXPECT_EQ(verdict.inner_wrong, 0u);
      EXPECT_EQ(verdict.inner_grey, 0u);
    }
  }
}

TEST_P(ShadowTest, TouchTheirCasters) {
  // A thin wall that stands on a floor: behind it no light leaks in, and before it no shadow lies.
  SceneMaker maker;
  Material paint;
  paint.roughness = 1.0f;
  paint.double_sided = true;
  const int material = maker.add(paint);
  maker.place(maker.add(make_quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, material)));
  maker.place(maker.add(make_quad({-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, material)));
  Light lamp;
  lamp.kind = Light::Kind::spot;
  lamp.position = {0.0, 3.0, 3.0};
  lamp.direction = {0.0, -1.0, -1.0};
  lamp.outer_angle = 0.7f;
  lamp.inner_angle = 0.6f;
  lamp.color = glm::vec3(100.0f);
  maker.add(lamp);
  const Scene scene = maker.finish();
  const Camera camera = make_camera("perspective:fov_deg=60", ImageSize{200, 200});
  prepare(scene);
  // Straight down on the wall's upper edge; a pixel is 8 mm of the floor, a texel 5 mm.
  const glm::dmat4 pose = look_at_worldFromCamera({0.0, 1.4, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
  RenderOptions options{.technique = GetParam(), .samples = 1};
  const FloatImage bright = draw_color(camera, pose, options);
  options.shadows = Shadows::cube;
  const FloatImage shadowed = draw_color(camera, pose, options);
  int leak_px = 0, early_px = 0;
  for (int y = 0; y < 200; ++y) {
    const double share = shadowed.at(100, y)[1] / bright.at(100, y)[1];
    if (y < 97) leak_px += share > 0.5;
    if (y >= 103) early_px += share < 0.5;
  }
  EXPECT_EQ(leak_px, 0);
  EXPECT_EQ(early_px, 0);
}

TEST_P(ShadowTest, FollowWhatMoves) {
  Scene scene = make_seam();
  const Camera camera = make_camera("perspective:fov_deg=90", ImageSize{64, 64});
  const glm::dmat4 pose(1.0);
  const RenderOptions options{.technique = GetParam(), .samples = 1, .shadows = Shadows::cube, .shadow_size = 128};
  prepare(scene);
  const FloatImage before = draw_color(camera, pose, options);
  EXPECT_EQ(largest_difference(before, draw_color(camera, pose, options)), 0.0);
  scene.instances.back().worldFromObject = translation({-0.5, 0.2, -1.5});
  follow(scene);
  const FloatImage after = draw_color(camera, pose, options);
  prepare(scene);
  EXPECT_GT(largest_difference(before, after), 0.1);
  EXPECT_EQ(largest_difference(after, draw_color(camera, pose, options)), 0.0);
}

class ShadowTechniquesTest : public GpuTest {};

TEST_F(ShadowTechniquesTest, AreTheSameInEveryTechniqueThatIsExactThere) {
  const Scene scene = make_seam();
  const Camera camera = make_camera("perspective:fov_deg=70", ImageSize{96, 96});
  const glm::dmat4 pose = look_at_worldFromCamera({0.3, 0.9, 0.0}, {0.3, 0.0, -3.0});
  prepare(scene);
  RenderOptions options{.technique = "raycast", .samples = 1, .shadows = Shadows::cube, .shadow_size = 256};
  const FloatImage truth = draw_color(camera, pose, options);
  size_t compared = 0;
  for (const std::string& technique : distinct_technique_names()) {
    // What a cube map does to edges is not what this test is about.
    if (!can_draw(technique, camera) || technique.starts_with("image-based")) continue;
    options.technique = technique;
    EXPECT_GT(psnr(truth, draw_color(camera, pose, options)), 40.0) << technique;  // observed: 70
    ++compared;
  }
  EXPECT_GE(compared, 4u);
}

TEST_P(ShadowTest, RefuseSizesThatMakeNoMap) {
  const Scene scene = make_seam();
  prepare(scene);
  const Camera camera = make_camera("perspective", ImageSize{16, 16});
  EXPECT_THROW(
      draw_color(camera, glm::dmat4(1.0), {.technique = GetParam(), .shadows = Shadows::cube, .shadow_size = 8}),
      CommandError);
  EXPECT_THROW(
      draw_color(camera, glm::dmat4(1.0), {.technique = GetParam(), .shadows = Shadows::cube, .shadow_size = 1 << 20}),
      MachineError);
  EXPECT_THROW(shadows_from_name("cubes"), CommandError);
}

INSTANTIATE_TEST_SUITE_P(Techniques, ShadowTest, ::testing::Values("raycast", "visibility:cpu"), [](const auto& shown) {
  return std::string(shown.param) == "raycast" ? "OpenGl" : "Processor";
});

}  // namespace
}  // namespace omma
