// The finder against brute force in double precision, in closed scenes, at ties, at the ends of single precision, on
// every SIMD target and any number of threads.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "omma/camera/ray_bundle.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/finder.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"
#include "tests/gpu/random_scenes.h"
#include "tests/proof.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

constexpr uint32_t none = meets_nothing;

struct Picture {
  std::vector<glm::uvec2> triangles;
  std::vector<float> distances;
  friend bool operator==(const Picture&, const Picture&) = default;
};

Picture find(const Finder& finder, const RayTree& rays, Solid solid = Solid::opaque) {
  Picture picture;
  picture.triangles.resize(size_t(rays.size().width) * size_t(rays.size().height));
  picture.distances.resize(picture.triangles.size());
  finder.nearest(rays, solid, picture.triangles, picture.distances);
  return picture;
}

IntImage ids_of(const Picture& picture, ImageSize size) {
  IntImage ids(size, 1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      *ids.at(x, y) = int32_t(picture.triangles[size_t(y) * size_t(size.width) + size_t(x)].x);
    }
  }
  return ids;
}

/// The lens's own example, its longer side scaled to `side` pixels.
Camera small_camera(const LensModel& model, int side) {
  const ImageSize own = make_camera(model.info.example).size();
  const double scale = double(side) / std::max(own.width, own.height);
  return make_camera(model.info.example,
                     ImageSize{int(std::lround(scale * own.width)), int(std::lround(scale * own.height))});
}

TEST(FinderTest, AgreesWithBruteForceThroughEveryLens) {
  const Scene scene = random_soup(200, 11);
  const glm::dmat4 pose = pose_at({0.3, -0.2, 0.1}, 0.4, 0.2);
  const Oracle oracle(scene, pose);
  const SceneIndex index(scene);
  const Finder finder(index, pose);
  Verdict total;
  for (const LensModel& model : lens_models()) {
    const Camera camera = small_camera(model, full_proof() ? 200 : 40);
    SCOPED_TRACE(model.info.example);
    const RayTree rays(rays_of(camera));
    const Picture picture = find(finder, rays);
    const Verdict verdict = judge(oracle, camera, ids_of(picture, camera.size()), {.radius = 1e-3});
    EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
    EXPECT_LE(verdict.edges + verdict.ties, 3u);
    total.hits += verdict.hits;
    for (size_t i = 0; i < picture.triangles.size(); ++i) {
      EXPECT_EQ(picture.triangles[i].x == none, std::isinf(picture.distances[i]));
      if (picture.triangles[i].x == none) continue;
      const glm::dvec3 direction(rays_of(camera).directions[i]);
      if (const auto hit = oracle.meet(picture.triangles[i].x, direction)) {
        EXPECT_EQ(picture.triangles[i].y, hit->instance);
        const double cosine = oracle.cosine(*hit, direction);
        if (cosine > 0.02) {
          EXPECT_NEAR(picture.distances[i] / hit->distance, 1.0, 1e-5);
        }
      }
    }
  }
  EXPECT_GT(total.hits, 20000u);
}

TEST(FinderTest, AgreesWithBruteForceInManyRandomScenes) {
  const int scenes = full_proof() ? 2000 : 60;
  const Camera fisheye = make_camera("equidistant:fov_deg=300", ImageSize{40, 40});
  const Camera panorama = make_camera("equirectangular", ImageSize{64, 32});
  size_t hits = 0, near_misses = 0;
  for (int i = 0; i < scenes; ++i) {
    std::mt19937 random(static_cast<unsigned>(i));
    std::normal_distribution<double> normal;
    const Scene scene = random_soup(4 + i % 90, unsigned(i));
    const glm::dmat4 pose = pose_at({normal(random), normal(random), normal(random)}, normal(random), normal(random));
    const Oracle oracle(scene, pose);
    const SceneIndex index(scene);
    const Finder finder(index, pose);
    for (const Camera& camera : {fisheye, panorama}) {
      const Verdict verdict =
          judge(oracle, camera, ids_of(find(finder, RayTree(rays_of(camera))), camera.size()), {.radius = 1e-3});
      EXPECT_EQ(verdict.wrong, 0u) << "scene " << i << ": " << verdict.first_wrong;
      hits += verdict.hits;
      near_misses += verdict.edges + verdict.ties;
    }
  }
  EXPECT_GT(hits, size_t(scenes) * 500u);
  EXPECT_LT(near_misses, hits / 10000);
}

TEST(FinderTest, NeitherHugeNorTinyScenesLoseAnything) {
  const Camera camera = make_camera("equirectangular", ImageSize{64, 32});
  const RayTree rays(rays_of(camera));
  std::vector<glm::uvec2> expected;
  // Powers of two, so that all of them are the same scene to the bit.
  for (const int exponent : {0, -40, 30, 90, -100}) {
    const Scene scene = random_soup(200, 5, std::ldexp(1.0f, exponent));
    const SceneIndex index(scene);
    const Finder finder(index, glm::dmat4(1.0));
    const Picture picture = find(finder, rays);
    if (exponent == 0) expected = picture.triangles;
    EXPECT_TRUE(picture.triangles == expected) << "times 2 to the " << exponent;
  }
  EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](const glm::uvec2& hit) { return hit.x != none; }), 1000);
}

TEST(FinderTest, EdgesFromNearToFarStayWhereTheyAre) {
  std::mt19937 random(41);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> exponent(-1.0f, 4.0f);
  Material material;
  material.double_sided = true;
  SceneMaker maker;
  Mesh mesh;
  mesh.material = maker.add(material);
  for (uint32_t i = 0; i < 300; ++i) {
    const glm::vec3 direction(0.15f * normal(random), 0.15f * normal(random), -1.0f);
    mesh.positions.push_back(std::pow(10.0f, exponent(random)) * direction);
    if (i % 3 == 2) mesh.triangles.emplace_back(i - 2, i - 1, i);
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  maker.place(maker.add(mesh), glm::dmat4(1.0));
  const Scene scene = maker.finish();
  const Camera camera =
      make_camera("perspective:fov_deg=20", full_proof() ? ImageSize{1600, 1200} : ImageSize{400, 300});
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  const Picture picture = find(finder, RayTree(rays_of(camera)));
  const Verdict verdict =
      judge(Oracle(scene, glm::dmat4(1.0)), camera, ids_of(picture, camera.size()), {.radius = 1e-3});
  EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
  EXPECT_LT(verdict.edges + verdict.ties, 20u);
  EXPECT_GT(verdict.hits, verdict.pixels / 4);
}

TEST(FinderTest, LosesNothingAMillionMetresAway) {
  const Camera camera = make_camera("equidistant:fov_deg=300", ImageSize{48, 48});
  const RayTree rays(rays_of(camera));
  Scene scene = random_soup(200, 9);
  const SceneIndex here_index(scene);
  const Finder here(here_index, glm::dmat4(1.0));
  const Picture expected = find(here, rays);
  const glm::dvec3 far(1048576.0, -2097152.0, 524288.0);
  for (Instance& instance : scene.instances) instance.worldFromObject[3] += glm::dvec4(far, 0.0);
  const SceneIndex there_index(scene);
  const Finder there(there_index, glm::translate(glm::dmat4(1.0), far));
  EXPECT_EQ(find(there, rays), expected);
}

TEST(FinderTest, ClosedScenesHaveNeitherHolesNorDoubleHits) {
  const int balls = full_proof() ? 200 : 3;
  Material glass;
  glass.alpha = Material::Alpha::blend;
  const RayTree rays(rays_of(make_camera("equirectangular", ImageSize{512, 256})));
  const std::vector<float> no_limit(512 * 256, std::numeric_limits<float>::infinity());
  for (int i = 0; i < balls; ++i) {
    for (const bool double_sided : {false, true}) {
      Material solid;
      solid.double_sided = glass.double_sided = double_sided;
      const Scene opaque = dented_ball(unsigned(i), solid), blended = dented_ball(unsigned(i), glass);
      const SceneIndex index(opaque), layers_index(blended);
      const Finder finder(index, glm::dmat4(1.0)), layers(layers_index, glm::dmat4(1.0));
      size_t holes = 0, not_one = 0;
      const Picture picture = find(finder, rays);
      for (const glm::uvec2& hit : picture.triangles) holes += hit.x == none;
      for (const auto& along_ray : layers.blended(rays, no_limit)) not_one += along_ray.size() != 1;
      EXPECT_EQ(holes, 0u) << i;
      EXPECT_EQ(not_one, 0u) << i;
    }
  }
}

TEST(FinderTest, ATieBelongsToOneSide) {
  // A grid whose corners have whole coordinates, and rays exactly through corners, edges and diagonals: single
  // precision computes every product without rounding.
  constexpr int side = 9;
  Material glass;
  glass.alpha = Material::Alpha::blend;
  glass.double_sided = true;
  Mesh mesh;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) mesh.positions.emplace_back(x - 4, y - 4, -8);
  }
  for (uint32_t y = 0; y + 1 < side; ++y) {
    for (uint32_t x = 0; x + 1 < side; ++x) {
      const uint32_t corner = y * side + x;
      mesh.triangles.emplace_back(corner, corner + 1, corner + side + 1);
      mesh.triangles.emplace_back(corner, corner + side + 1, corner + side);
    }
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  RayMap map{{29, 29}, {}, ""};
  for (int y = -14; y <= 14; ++y) {
    for (int x = -14; x <= 14; ++x) map.directions.emplace_back(0.25f * float(x), 0.25f * float(y), -8.0f);
  }
  const RayTree rays(map);
  SceneMaker maker;
  mesh.material = maker.add(glass);
  maker.place(maker.add(mesh), glm::dmat4(1.0));
  const Scene scene = maker.finish();
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  const auto layers = finder.blended(rays, std::vector<float>(29 * 29, std::numeric_limits<float>::infinity()));
  for (size_t i = 0; i < layers.size(); ++i) EXPECT_EQ(layers[i].size(), 1u) << "ray " << i;
  // Two triangles at one place: the lower id is seen, wherever it stands in the tree.
  const Picture labels = find(finder, rays, Solid::labels);
  Mesh twice = mesh;
  twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  SceneMaker second;
  twice.material = second.add(glass);
  second.place(second.add(twice), glm::dmat4(1.0));
  const Scene doubled = second.finish();
  const SceneIndex both_index(doubled);
  const Finder both(both_index, glm::dmat4(1.0));
  EXPECT_EQ(find(both, rays, Solid::labels), labels);
}

TEST(FinderTest, SeesTrianglesAroundTheCentreAndNotThoseAtIt) {
  Material material;
  material.double_sided = true;
  SceneMaker maker;
  Mesh mesh;
  mesh.material = maker.add(material);
  // Below, wide enough to reach beyond the horizon on all sides but for its own height; one with a corner at the
  // centre; one whose plane goes through the centre; a line; a point.
  mesh.positions = {{-1000, -1, -1000}, {1000, -1, -1000}, {0, -1, 2000}, {0, 0, 0}, {1, 5, 0}, {0, 5, 1},
                    {-3, 3, 0},         {3, 3, 0},         {0, -3, 0},    {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {9, 9, 10}, {3, 3, 3}};
  maker.place(maker.add(mesh), glm::dmat4(1.0));
  const Scene scene = maker.finish();
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  const Camera camera = make_camera("equirectangular", ImageSize{360, 180});
  const Picture picture = find(finder, RayTree(rays_of(camera)));
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 360; ++x) {
      const glm::uvec2 hit = picture.triangles[size_t(y * 360 + x)];
      // The horizon itself is left out.
      if (y > 91 || y < 89) {
        EXPECT_EQ(hit.x, y > 91 ? 0u : none) << x << ", " << y;
      }
    }
  }
}

TEST(FinderTest, EmptyScenesAndSmallImages) {
  const Scene empty;
  const SceneIndex nothing_index(empty);
  const Finder nothing(nothing_index, glm::dmat4(1.0));
  EXPECT_FALSE(nothing_index.has_blending());
  for (const glm::uvec2& hit :
       find(nothing, RayTree(rays_of(make_camera("equirectangular", ImageSize{33, 17})))).triangles) {
    EXPECT_EQ(hit, glm::uvec2(none));
  }
  const Scene scene = dented_ball(1, {});
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  const Picture one = find(finder, RayTree(RayMap{{1, 1}, {{0.6f, 0.0f, -0.8f}}, ""}));
  EXPECT_NE(one.triangles[0].x, none);
  EXPECT_EQ(find(finder, RayTree(RayMap{{1, 1}, {glm::vec3(0.0f)}, ""})).triangles[0], glm::uvec2(none, no_ray));
  EXPECT_TRUE(find(finder, RayTree(RayMap{{0, 0}, {}, ""})).triangles.empty());
}

TEST(FinderTest, ThreadsChangeNothing) {
  const Scene scene = random_soup(2000, 21);
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  const RayTree rays(rays_of(make_camera("equidistant:fov_deg=220", ImageSize{200, 150})));
  const Picture expected = find(finder, rays);
  // More than there may be cores.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena arena(threads);
    for (int run = 0; run < 3; ++run) arena.execute([&] { EXPECT_EQ(find(finder, rays), expected) << threads; });
  }
}

TEST(FinderTest, SimdTargetsAgree) {
  const Scene scene = random_soup(2000, 23);
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  const RayTree rays(rays_of(make_camera("equidistant:fov_deg=220", ImageSize{200, 150})));
  const Picture expected = find(finder, rays);
  const std::vector<std::string> targets = simd_targets();
  ASSERT_GE(targets.size(), 2u);
  for (const std::string& target : targets) {
    use_simd_target(target);
    const Picture picture = find(finder, rays);
    size_t different = 0;
    for (size_t i = 0; i < picture.triangles.size(); ++i) {
      different += picture.triangles[i] != expected.triangles[i];
      if (picture.triangles[i] == expected.triangles[i] && picture.triangles[i].x != none) {
        EXPECT_NEAR(picture.distances[i] / expected.distances[i], 1.0, 1e-3);
      }
    }
    std::cout << target << ": " << different << " of " << picture.triangles.size() << " rays differ\n";
    // Observed: none with fused multiplication and addition; at most 1 without, beside an edge.
    EXPECT_LE(different, 3u) << target;
  }
  use_simd_target("");
}

TEST(FinderTest, RefitEqualsRebuild) {
  Scene scene = random_soup(600, 31);
  SceneIndex refitted(scene);
  SceneChanges changes{.moved = true};
  for (Mesh& mesh : scene.meshes) {
    changes.deformed.insert(int(&mesh - scene.meshes.data()));
    for (glm::vec3& p : mesh.positions) p = glm::vec3(1.3f * p.z, p.x + 0.5f * p.y, p.y - 1.0f);
  }
  scene.instances[0].worldFromObject = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 1.0, -2.0));
  refitted.update(changes);
  const SceneIndex rebuilt(scene);
  const RayTree rays(rays_of(make_camera("equidistant:fov_deg=220", ImageSize{200, 150})));
  EXPECT_EQ(find(Finder(refitted, glm::dmat4(1.0)), rays), find(Finder(rebuilt, glm::dmat4(1.0)), rays));
}

}  // namespace
}  // namespace omma
