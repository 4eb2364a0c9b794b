// Channels that the processor draws, against brute force in double precision; tiles, refusals, scenes that move.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/software/seen_triangle.h"
#include "omma/software/software_renderer.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"

namespace omma {
namespace {

constexpr Channel all_but_color[] = {Channel::distance, Channel::z,  Channel::normal, Channel::position,
                                     Channel::uv,       Channel::id, Channel::object, Channel::material};

/// Balls under every kind of transform over a floor, `origin` metres from the world's.
Scene make_balls(const glm::dvec3& origin) {
  SceneMaker maker;
  const int ball = maker.add(make_ball(1.0f, maker.add(unlit({1, 0, 0, 1}))));
  Material sheet;
  sheet.double_sided = true;
  const int floor = maker.add(make_quad({-20, -2, 20}, {20, -2, 20}, {20, -2, -20}, {-20, -2, -20}, maker.add(sheet)));
  const auto at = [&](const glm::dvec3& by) { return translation(origin + by); };
  maker.place(floor, at({0, 0, 0}));
  maker.place(ball, at({0, 0, -4}));
  maker.place(ball, glm::scale(at({3, 0, -3}), {-1.0, 1.0, 1.0}));
  maker.place(ball, glm::scale(glm::rotate(at({0, 2.5, 4}), 0.7, {1, 2, 3}), {1.5, -0.5, 0.8}));
  return maker.finish();
}

TEST(SoftwareRendererTest, AgreesWithBruteForce) {
  for (const glm::dvec3 origin : {glm::dvec3(0.0), glm::dvec3(1e6, 3e5, -1e6)}) {
    const Scene scene = make_balls(origin);
    const glm::dmat4 pose =
        look_at_worldFromCamera(origin + glm::dvec3(0.3, 0.4, 0.2), origin + glm::dvec3(0.2, 0, -4));
    const Oracle oracle(scene, pose);
    LazySceneIndex index(scene);
    SoftwareRenderer renderer(index);
    size_t compared = 0, seen = 0;
    double distance = 0.0, normal = 0.0, uv = 0.0, position = 0.0;
    for (const char* text : {"equidistant:fov_deg=300", "equirectangular", "perspective:fov_deg=100"}) {
      const Camera camera = make_camera(text, ImageSize{120, 60});
      const auto pictures = renderer.render(camera, pose, all_but_color);
      for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 120; ++x) {
          const auto ray = camera.unproject({x + 0.5, y + 0.5});
          const auto hit = ray ? oracle.nearest(ray->direction) : std::nullopt;
          const auto whole = [&](Channel channel) { return *std::get<IntImage>(pictures.at(channel)).at(x, y); };
          const auto real = [&](Channel channel) { return std::get<FloatImage>(pictures.at(channel)).at(x, y); };
          seen += whole(Channel::id) >= 0;
          if (!hit || whole(Channel::id) != int32_t(hit->triangle)) continue;
          ++compared;
          const double reach = hit->distance / oracle.cosine(*hit, ray->direction);
          const glm::dvec3 point(pose * glm::dvec4(hit->distance * ray->direction, 1.0));
          const auto vector = [&](Channel channel) {
            return glm::dvec3(real(channel)[0], real(channel)[1], real(channel)[2]);
          };
          const auto raise = [](double& error, double value) { error = std::max(error, value); };
          raise(distance, std::abs(*real(Channel::distance) - hit->distance) / reach);
          raise(distance, std::abs(*real(Channel::z) + hit->distance * ray->direction.z) / reach);
          raise(position, glm::distance(vector(Channel::position), point) / (glm::length(point) + reach));
          raise(normal, glm::distance(vector(Channel::normal), oracle.normal(*hit)));
          raise(uv, glm::distance(glm::dvec2(real(Channel::uv)[0], real(Channel::uv)[1]), oracle.uv(*hit)) /
                        (1.0 + oracle.uv_per_metre(*hit) * reach));
          const Instance& instance = scene.instances[hit->instance];
          EXPECT_EQ(whole(Channel::object), instance.object);
          EXPECT_EQ(whole(Channel::material), scene.meshes[size_t(instance.mesh)].material);
        }
      }
    }
    EXPECT_GT(compared, 8000u);
    EXPECT_GE(compared, seen - 3);
    // Observed: 1.2e-7, 1.7e-7, 5.2e-7, 1.2e-7: rays and results are in single precision, what is between in double.
    EXPECT_LT(distance, 5e-7);
    EXPECT_LT(position, 5e-7);
    EXPECT_LT(normal, 2e-6);
    EXPECT_LT(uv, 5e-7);
  }
}

TEST(SeenTriangleTest, EdgeOnTheFindersDistanceStands) {
  // The camera lies in the plane of the square, whose plane then says nothing of distances.
  SceneMaker maker;
  maker.place(maker.add(make_quad({-1, 0, -3}, {1, 0, -3}, {1, 0, -5}, {-1, 0, -5}, maker.add(Material{}))));
  const Scene scene = maker.finish();
  const SeenInstance instance(scene, scene.instances[0], glm::dmat4(1.0));
  for (const double distance : {3.0, 3.5, 4.0, 4.9, 100.0}) {
    const SeenTriangle triangle(instance, 1);  // corners (-1, -3), (1, -5), (-1, -5)
    const SeenPoint point = triangle.at({0.0, 0.0, -1.0}, distance);
    EXPECT_EQ(point.distance, distance);
    EXPECT_GE(std::min({point.bc.x, point.bc.y, 1.0 - point.bc.x - point.bc.y}), -1e-12) << distance;
    EXPECT_NEAR(glm::length(triangle.normal(point)), 1.0, 1e-12);
    const glm::dvec2 uv = triangle.uv(point);
    EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
  }
  // A point that is in the triangle stays where it is.
  const glm::dvec3 inside = glm::normalize(glm::dvec3(-0.5, 0.0, -4.75));
  const SeenTriangle triangle(instance, 1);
  const glm::dvec2 uv = triangle.uv(triangle.at(inside, glm::length(glm::dvec3(-0.5, 0.0, -4.75))));
  EXPECT_NEAR(uv.x, 0.25, 1e-12);
  EXPECT_NEAR(uv.y, 0.875, 1e-12);
}

TEST(SoftwareRendererTest, OneFindingGivesColorAndTheOthersWhatTwoGive) {
  const Camera camera = make_camera("equidistant:fov_deg=200", ImageSize{70, 50});
  constexpr Channel color[] = {Channel::color};
  std::vector<Channel> all(std::begin(all_but_color), std::end(all_but_color));
  all.push_back(Channel::color);
  const Scene solid = make_balls(glm::dvec3(0.0)), blended = make_ball_and_pane();
  for (const Scene* scene : {&solid, &blended}) {
    LazySceneIndex index(*scene);
    SoftwareRenderer renderer(index);
    const auto together = renderer.render(camera, glm::dmat4(1.0), all, {.samples = 1});
    auto apart = renderer.render(camera, glm::dmat4(1.0), all_but_color);
    apart.merge(renderer.render(camera, glm::dmat4(1.0), color, {.samples = 1}));
    ASSERT_EQ(together.size(), apart.size());
    for (const auto& [channel, image] : together) {
      std::visit(
          [&, c = channel](const auto& typed) {
            EXPECT_EQ(std::get<std::decay_t<decltype(typed)>>(apart.at(c)).values, typed.values);
          },
          image);
    }
  }
}

TEST(SoftwareRendererTest, FollowsWhatMoves) {
  Scene scene = make_ball_and_pane();
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const Camera camera = make_camera("equidistant:fov_deg=180", ImageSize{64, 64});
  constexpr Channel wanted[] = {Channel::distance, Channel::object};
  std::mt19937 random(3);
  for (int frame = 0; frame < 6; ++frame) {
    const SceneChanges changes = move_ball(scene, frame, random);
    index.update(changes);
    renderer.update(changes);
    const LazySceneIndex index_anew(scene);
    const SoftwareRenderer anew(index_anew);
    const auto followed = renderer.render(camera, glm::dmat4(1.0), wanted);
    const auto expected = anew.render(camera, glm::dmat4(1.0), wanted);
    EXPECT_EQ(std::get<FloatImage>(followed.at(Channel::distance)).values,
              std::get<FloatImage>(expected.at(Channel::distance)).values);
    EXPECT_EQ(std::get<IntImage>(followed.at(Channel::object)).values,
              std::get<IntImage>(expected.at(Channel::object)).values);
  }
}

TEST(SoftwareRendererTest, RefusesWhatItCannotDraw) {
  const Scene scene = make_ball_and_pane();
  LazySceneIndex index(scene);
  SoftwareRenderer renderer(index);
  const Camera camera = make_camera("equidistant", ImageSize{8, 8});
  constexpr Channel color[] = {Channel::id, Channel::color}, id[] = {Channel::id};
  EXPECT_THROW(renderer.render(camera, glm::dmat4(1.0), color, {.samples = 0}), CommandError);
  EXPECT_THROW(renderer.render(camera, glm::dmat4(1.0), std::span<const Channel>()), CommandError);
  const Scene empty;
  const LazySceneIndex no_index(empty);
  const SoftwareRenderer nothing(no_index);
  const auto pictures = nothing.render(camera, glm::dmat4(1.0), id);
  for (const int32_t value : std::get<IntImage>(pictures.at(Channel::id)).values) EXPECT_EQ(value, -1);
}

}  // namespace
}  // namespace omma
