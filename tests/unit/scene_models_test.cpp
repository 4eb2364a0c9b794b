// Scene files that others made: Debian's assimp-testmodels, and real scenes where somebody has put them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "omma/base/error.h"
#include "omma/scene/scene.h"
#include "tests/places.h"
#include "tests/unit/scene_invariants.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> test_models() {
  std::vector<fs::path> models;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(places::test_models, ignored)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    for (const char* known : {".glb", ".gltf", ".obj", ".ply", ".stl", ".dae", ".fbx"}) {
      if (extension == known) models.push_back(entry.path());
    }
  }
  std::sort(models.begin(), models.end());
  return models;
}

TEST(TestModels, AreSoundScenesAtAnyTimeOrRefused) {
  const std::vector<fs::path> models = test_models();
  if (models.empty()) GTEST_SKIP() << "no models in " << places::test_models << "; install assimp-testmodels";
  size_t loaded = 0;
  for (const fs::path& path : models) {
    SCOPED_TRACE(path.string());
    try {
      Scene scene = load_scene_file(path);
      expect_sound(scene);
      for (const Animation& animation : scene.animations) {
        set_time(scene, 0.37 * animation.duration, animation.name);
        expect_sound(scene);
      }
      ++loaded;
    } catch (const InputError&) {
    }
  }
  RecordProperty("loaded", static_cast<int>(loaded));
  // 104 of Debian 12's 139 hold triangles that can be drawn; the rest are broken on purpose, or points and lines.
  EXPECT_GE(loaded, models.size() * 7 / 10);
}

Scene test_model(const char* name) { return load_scene_file(fs::path(places::test_models) / name); }

#define OMMA_REQUIRE(folder, name) \
  if (!fs::exists(fs::path(folder) / (name))) GTEST_SKIP() << (folder) << "/" << (name) << " is absent"

TEST(TestModels, MorphedCubeMovesWithTime) {
  OMMA_REQUIRE(places::test_models, "glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf");
  Scene scene = test_model("glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf");
  ASSERT_EQ(scene.meshes[0].morph_targets.size(), 2u);
  ASSERT_EQ(scene.animations.size(), 1u);
  const std::vector<glm::vec3> at_rest = scene.meshes[0].positions;
  set_time(scene, 0.5 * scene.animations[0].duration);
  EXPECT_NE(scene.meshes[0].positions, at_rest);
  expect_sound(scene);
  set_time(scene, scene.animations[0].duration);
  EXPECT_EQ(scene.meshes[0].positions, at_rest);
}

TEST(TestModels, SkinnedStripBends) {
  OMMA_REQUIRE(places::test_models, "glTF2/simple_skin/simple_skin.gltf");
  Scene scene = test_model("glTF2/simple_skin/simple_skin.gltf");
  ASSERT_TRUE(scene.meshes[0].skin);
  ASSERT_FALSE(scene.animations.empty());
  const Bounds before = scene.bounds();
  set_time(scene, 1.0);
  EXPECT_GT(glm::length(scene.bounds().extent() - before.extent()), 0.1);
}

TEST(TestModels, UnitsBecomeMetres) {
  OMMA_REQUIRE(places::test_models, "FBX/phong_cube.fbx");
  // A cube of one unit in a file that leaves the unit at FBX's centimetre.
  EXPECT_NEAR(test_model("FBX/phong_cube.fbx").bounds().extent().x, 0.01, 1e-6);
  // A duck 165 units long in a file that says <unit meter="0.01"/>.
  EXPECT_NEAR(test_model("Collada/duck.dae").bounds().extent().x, 1.65, 0.01);
}

TEST(TestModels, ColladaCamerasAndLightsComeAlong) {
  OMMA_REQUIRE(places::test_models, "Collada/lights.dae");
  const Scene scene = test_model("Collada/lights.dae");
  EXPECT_FALSE(scene.lights.empty());
  EXPECT_FALSE(test_model("Collada/cameras.dae").cameras.empty());
}

struct RealScene {
  const char* path;
  size_t triangles;
  size_t textures;
  size_t materials;
  glm::dvec3 min, max;  ///< of file units, from its README
};

TEST(RealScenes, HaveTheTrianglesTexturesAndBoundsOfTheirReadme) {
  OMMA_REQUIRE(places::shared_data, "bunny.ply");
  const RealScene scenes[] = {
      {"sponza/sponza.gltf", 262267, 24, 25, {-15.365, -1.012, -9.463}, {14.395, 11.434, 8.843}},
      {"city/city.glb", 195756, 1, 1, {-13, 0, -13}, {12, 6.81, 12}},
      {"city/delft.glb", 36267, 0, 7, {-262.19, 0, -163.82}, {262.19, 17.30, 163.82}},
      {"bunny.ply", 69451, 0, 1, {-0.0947, 0.0330, -0.0619}, {0.0610, 0.1873, 0.0588}},
      {"dragon.ply", 871414, 0, 1, {-0.1083, 0.0527, -0.0504}, {0.0966, 0.1972, 0.0412}},
      {"teapot.obj", 6320, 0, 1, {-3, 0, -2}, {3.434, 3.15, 2}},
      {"spot.obj", 5856, 0, 1, {-0.472, -0.737, -0.669}, {0.472, 0.954, 1.049}},
      {"tree_oak.glb", 22566, 2, 2, {-10.76, 0, -11.37}, {10.03, 18.79, 5.88}},
      {"tree_pine.glb", 19872, 2, 2, {-3.28, 0, -3.04}, {2.89, 10.26, 2.88}},
  };
  for (const RealScene& real : scenes) {
    SCOPED_TRACE(real.path);
    ::testing::internal::CaptureStderr();
    const Scene scene = load_scene_file(fs::path(places::shared_data) / real.path);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    expect_sound(scene);
    EXPECT_EQ(scene.triangle_count(), real.triangles);
    EXPECT_EQ(scene.textures.size(), real.textures);
    EXPECT_EQ(scene.materials.size(), real.materials);
    // Two decimals in the large ones: half a centimetre an axis.
    const double rounding = 0.0087 * std::max(1.0, glm::length(real.max - real.min) / 30.0);
    EXPECT_LT(glm::distance(scene.bounds().min, real.min), rounding);
    EXPECT_LT(glm::distance(scene.bounds().max, real.max), rounding);
  }
}

TEST(RealScenes, SponzaMasksItsPlants) {
  OMMA_REQUIRE(places::shared_data, "sponza/sponza.gltf");
  const Scene scene = load_scene_file(fs::path(places::shared_data) / "sponza/sponza.gltf");
  EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(),
                          [](const Material& m) { return m.alpha == Material::Alpha::mask; }),
            3);
}

TEST(RealScenes, FoxRunsAndComesBack) {
  OMMA_REQUIRE(places::shared_data, "fox.glb");
  Scene fox = load_scene_file(fs::path(places::shared_data) / "fox.glb");
  EXPECT_EQ(fox.triangle_count(), 576u);
  ASSERT_EQ(fox.animations.size(), 3u);
  ASSERT_TRUE(fox.meshes[0].skin);
  EXPECT_EQ(fox.meshes[0].skin->joints.size(), 24u);
  for (const Animation& animation : fox.animations) {
    SCOPED_TRACE(animation.name);
    EXPECT_GT(animation.duration, 0.5);
    set_time(fox, 0.0, animation.name);
    const std::vector<glm::vec3> begin = fox.meshes[0].positions;
    set_time(fox, 0.4 * animation.duration, animation.name);
    expect_sound(fox);
    float furthest = 0.0f;
    for (size_t i = 0; i < begin.size(); ++i)
      furthest = std::max(furthest, glm::distance(begin[i], fox.meshes[0].positions[i]));
    EXPECT_GT(furthest, 1.0f) << "the fox is 155 units long";
    set_time(fox, animation.duration, animation.name);
    EXPECT_EQ(fox.meshes[0].positions, begin);
  }
}

TEST(RealScenes, MilkTruckWheelsTurn) {
  OMMA_REQUIRE(places::shared_data, "milk_truck.glb");
  Scene truck = load_scene_file(fs::path(places::shared_data) / "milk_truck.glb");
  expect_sound(truck);
  size_t stored = 0;
  for (const Mesh& mesh : truck.meshes) stored += mesh.triangles.size();
  EXPECT_EQ(stored, 2856u);
  std::vector<glm::dmat4> before;
  for (const Instance& instance : truck.instances) before.push_back(instance.worldFromObject);
  set_time(truck, 0.3 * truck.animations.at(0).duration);
  size_t turned = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    const glm::dmat4& now = truck.instances[i].worldFromObject;
    EXPECT_LT(glm::distance(glm::dvec3(now[3]), glm::dvec3(before[i][3])), 1e-9) << "a wheel turns in its place";
    turned += glm::distance(glm::dvec3(now[1]), glm::dvec3(before[i][1])) > 0.1;
  }
  EXPECT_EQ(turned, 2u);
}

}  // namespace
}  // namespace omma
