// What points see of their hemispheres, against closed forms and against rays that Embree traces.
#include <fmt/core.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/oracle/embree_scene.h"
#include "omma/probe/probe.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/proof.h"

namespace omma {
namespace {

constexpr double pi = glm::pi<double>();

class ProbeTest : public GpuTest, public testing::WithParamInterface<std::string> {
 protected:
  static ProbeResult probe(const Scene& scene, const ProbePoint& point, ProbeOptions options = {}) {
    options.render.technique = GetParam();
    prepare(scene);
    Prober prober(prepared(), options);
    ProbeResult result;
    prober.look_cosine_weighted(point, result);
    prober.look_unweighted(point, result);
    return result;
  }
};

const ProbePoint on_the_ground{{0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}};

Material paint(const glm::vec3& color) {
  Material material = unlit(glm::vec4(color, 1.0f));
  material.double_sided = true;
  return material;
}

void add_ground(SceneMaker& maker, int material) {
  constexpr float far = 1000.0f;
  maker.place(maker.add(make_quad({-far, 0, far}, {far, 0, far}, {far, 0, -far}, {-far, 0, -far}, material)));
}

/// Parallels and meridians fine enough that its outline is a circle to 1e-3.
Mesh make_sphere(const glm::vec3& centre, float radius, int material) {
  constexpr unsigned rows = 64, columns = 128;
  Mesh mesh;
  mesh.material = material;
  for (unsigned j = 0; j <= rows; ++j) {
    for (unsigned i = 0; i <= columns; ++i) {
      const float polar = float(pi) * float(j) / rows, around = 2.0f * float(pi) * float(i) / columns;
      const glm::vec3 out(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
      mesh.positions.push_back(centre + radius * out);
      mesh.normals.push_back(out);
      mesh.uvs.emplace_back(0.0f);
      if (j == rows || i == columns) continue;
      const unsigned a = j * (columns + 1) + i, b = a + columns + 1;
      if (j > 0) mesh.triangles.emplace_back(a, a + 1, b);
      if (j + 1 < rows) mesh.triangles.emplace_back(a + 1, b + 1, b);
    }
  }
  return mesh;
}

TEST_P(ProbeTest, SeesAllOfTheSkyOnAPlainAndNoneInARoom) {
  SceneMaker plain;
  add_ground(plain, plain.add(paint({1, 0, 0})));
  ProbeOptions options;
  options.render.background = glm::vec3(0.2f, 0.4f, 0.8f);
  const Scene open = plain.finish();
  ProbeResult seen = probe(open, on_the_ground, options);
  EXPECT_EQ(seen.occlusion, 0.0);
  EXPECT_EQ(seen.sky, 1.0);
  EXPECT_DOUBLE_EQ(seen.open_solid_angle, 2.0 * pi);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.irradiance[c], pi * (*options.render.background)[c], 2e-3);

  SceneMaker room;
  const int wall = room.add(paint({0.5, 0.25, 1.0}));
  for (const float y : {-0.5f, 2.5f}) {
    room.place(room.add(make_quad({-2, y, 2}, {2, y, 2}, {2, y, -2}, {-2, y, -2}, wall)));
  }
  for (const float side : {-2.0f, 2.0f}) {
    room.place(room.add(make_quad({side, -0.5, -2}, {side, -0.5, 2}, {side, 2.5, 2}, {side, 2.5, -2}, wall)));
    room.place(room.add(make_quad({-2, -0.5, side}, {2, -0.5, side}, {2, 2.5, side}, {-2, 2.5, side}, wall)));
  }
  const Scene closed = room.finish();
  for (const glm::dvec3& normal : {glm::dvec3(0, 1, 0), glm::dvec3(-1, 2, 0.5), glm::dvec3(0, -1, 0)}) {
    seen = probe(closed, {{0.3, 0.2, -0.4}, normal}, options);
    EXPECT_EQ(seen.occlusion, 1.0);
    EXPECT_EQ(seen.sky, 0.0);
    EXPECT_EQ(seen.open_solid_angle, 0.0);
    EXPECT_NEAR(seen.irradiance.x, 0.5 * pi, 2e-3);
    EXPECT_NEAR(seen.irradiance.y, 0.25 * pi, 2e-3);
  }
}

TEST_P(ProbeTest, SeesHalfTheSkyAndMoreUnderAWall) {
  // A wall without end, d away and h high, covers the wedge up to the elevation atan(h / d).
  double most = 0.0;
  for (const double height : {0.3, 1.0, 4.0}) {
    SceneMaker maker;
    const int grey = maker.add(paint({0, 0, 0}));
    add_ground(maker, grey);
    constexpr float far = 1000.0f;
    const auto h = float(height);
    maker.place(maker.add(make_quad({-far, 0, -1}, {far, 0, -1}, {far, h, -1}, {-far, h, -1}, grey)));
    ProbeOptions options;
    options.render.background = glm::vec3(1.0f);
    const double elevation = std::atan(height);
    const Scene scene = maker.finish();
    const ProbeResult seen = probe(scene, on_the_ground, options);
    const double sky = 0.5 * (1.0 + std::cos(elevation));
    EXPECT_NEAR(seen.sky, sky, 0.004) << height;
    EXPECT_NEAR(seen.irradiance.x, pi * sky, 0.014) << height;
    EXPECT_NEAR(seen.open_solid_angle, 2.0 * pi - 2.0 * elevation, 0.03) << height;
    EXPECT_NEAR(seen.occlusion, 1.0 - seen.sky, 1e-12);
    most = std::max(most, std::abs(seen.sky - sky));
  }
  fmt::print("{}: at most {:.5f} off under a wall\n", GetParam(), most);
}

TEST_P(ProbeTest, SeesASphereAsTheSquaredSineOfItsHalfAngle) {
  double most = 0.0;
  for (const double half_angle : {0.1, 0.4, 0.9}) {
    SceneMaker maker;
    const int grey = maker.add(paint({0, 0, 0}));
    add_ground(maker, grey);
    maker.place(maker.add(make_sphere({0, 5, 0}, float(5.0 * std::sin(half_angle)), grey)));
    const Scene scene = maker.finish();
    ProbeOptions options;
    options.size = 128;
    ProbeResult seen = probe(scene, on_the_ground, options);
    const double covered = std::pow(std::sin(half_angle), 2.0);
    EXPECT_NEAR(seen.occlusion, covered, 0.002);
    EXPECT_NEAR(seen.open_solid_angle, 2.0 * pi * std::cos(half_angle), 0.015);
    most = std::max(most, std::abs(seen.occlusion - covered));
    options.max_distance = 0.5;  // the sphere's nearest point is farther
    seen = probe(scene, on_the_ground, options);
    EXPECT_EQ(seen.occlusion, 0.0);
    EXPECT_NEAR(seen.sky, 1.0 - covered, 0.002);
    EXPECT_DOUBLE_EQ(seen.open_solid_angle, 2.0 * pi);
  }
  fmt::print("{}: at most {:.5f} off under a sphere\n", GetParam(), most);
}

/// Points of surfaces, spread over what the scene's own camera sees.
std::vector<ProbePoint> points_in_view(const std::map<Channel, Image>& pictures) {
  const auto& place = std::get<FloatImage>(pictures.at(Channel::position));
  const auto& normal = std::get<FloatImage>(pictures.at(Channel::normal));
  std::vector<ProbePoint> points;
  for (int y = 2; y < place.size.height; y += 4) {
    for (int x = 2; x < place.size.width; x += 4) {
      const float *p = place.at(x, y), *n = normal.at(x, y);
      if (std::isfinite(p[0])) points.push_back({{p[0], p[1], p[2]}, {n[0], n[1], n[2]}});
    }
  }
  return points;
}

/// Cosine-distributed, seeded, one in each of side x side strata.
std::vector<glm::vec3> cosine_rays(int side) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::vec3> rays;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double r = std::sqrt((i + unit(random)) / side), angle = 2.0 * pi * (j + unit(random)) / side;
      rays.emplace_back(r * std::cos(angle), r * std::sin(angle), -std::sqrt(1.0 - r * r));
    }
  }
  return rays;
}

TEST_P(ProbeTest, AgreesWithRays) {
  constexpr int side = 128;  // the rays' own error is below 0.001
  constexpr double reach = 10.0;
  const std::vector<glm::vec3> rays = cosine_rays(side);
  for (const char* name : {"temple", "city"}) {
    const Scene scene = load_scene(name);
    prepare(scene);
    std::vector<ProbePoint> points =
        points_in_view(draw(make_camera("equidistant:fov_deg=180", ImageSize{24, 24}), default_pose(scene),
                            {Channel::position, Channel::normal}, {.technique = "raycast"}));
    constexpr size_t enough = 8;
    if (!full_proof() && points.size() > enough) {  // evenly over all of them
      for (size_t i = 0; i < enough; ++i) points[i] = points[i * points.size() / enough];
      points.resize(enough);
    }
    ProbeOptions options;
    options.render.technique = GetParam();
    options.max_distance = reach;
    Prober prober(prepared(), options);
    EmbreeScene trees(scene);
    double most = 0.0, sum = 0.0, covered_sum = 0.0;
    for (const ProbePoint& point : points) {
      ProbeResult seen;
      prober.look_cosine_weighted(point, seen);
      glm::dmat4 pose = look_at_worldFromCamera(glm::dvec3(0.0), point.normal);
      pose[3] = glm::dvec4(point.position + options.offset * glm::normalize(point.normal), 1.0);
      trees.set_view(pose);
      std::vector<RayHit> hits(rays.size());
      trees.nearest({}, rays, side, Solid::labels, hits);
      size_t covered = 0;
      for (const RayHit& hit : hits) covered += hit.distance < reach;
      const double share = double(covered) / double(rays.size()), error = std::abs(seen.occlusion - share);
      most = std::max(most, error);
      sum += error;
      covered_sum += share;
    }
    const auto count = double(points.size());
    fmt::print("{}, {}: {} points, {:.2f} covered; off by {:.5f} on average, {:.5f} at most\n", GetParam(), name,
               points.size(), covered_sum / count, sum / count, most);
    EXPECT_GE(points.size(), 8u);
    EXPECT_GT(covered_sum, 0.02 * count);
    EXPECT_LT(most, 0.01);
  }
}

TEST_P(ProbeTest, RefusesWhatMakesNoSense) {
  SceneMaker maker;
  add_ground(maker, maker.add(paint({1, 1, 1})));
  const Scene scene = maker.finish();
  EXPECT_THROW(probe(scene, {{0, 0, 0}, {0, 0, 0}}), CommandError);
  EXPECT_THROW(probe(scene, {{0, NAN, 0}, {0, 1, 0}}), CommandError);
  for (const int size : {4, 5000}) {
    ProbeOptions options;
    options.size = size;
    EXPECT_THROW(probe(scene, on_the_ground, options), CommandError);
  }
  ProbeOptions options;
  options.max_distance = 0.0;
  EXPECT_THROW(probe(scene, on_the_ground, options), CommandError);
  options.max_distance = 1.0;
  options.offset = -1.0;
  EXPECT_THROW(probe(scene, on_the_ground, options), CommandError);
}

INSTANTIATE_TEST_SUITE_P(Techniques, ProbeTest, testing::Values("raycast", "nonlinear"),
                         [](const auto& test) { return test_name(test.param); });

}  // namespace
}  // namespace omma
