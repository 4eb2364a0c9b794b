#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "omma/base/error.h"
#include "omma/scene/scene.h"
#include "tests/unit/scene_invariants.h"

namespace omma {
namespace {

std::vector<std::string> all_scenes() {
  std::vector<std::string> texts;
  for (const BuiltinScene& scene : builtin_scenes()) texts.push_back(scene.name);
  texts.insert(texts.end(), {"city:blocks=1,seed=9", "city:blocks=4", "facade:detail=0", "facade:detail=2",
                             "terrain:triangles=1000", "terrain:triangles=20000,seed=3"});
  return texts;
}

class BuiltinSceneTest : public ::testing::TestWithParam<std::string> {};

TEST_P(BuiltinSceneTest, IsSound) { expect_sound(load_scene(GetParam())); }

TEST_P(BuiltinSceneTest, IsTheSameEachTime) {
  const Scene a = load_scene(GetParam()), b = load_scene(GetParam());
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].positions, b.meshes[m].positions);
    EXPECT_EQ(a.meshes[m].triangles, b.meshes[m].triangles);
    EXPECT_EQ(a.meshes[m].colors, b.meshes[m].colors);
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (size_t t = 0; t < a.textures.size(); ++t) EXPECT_EQ(a.textures[t].texels, b.textures[t].texels);
}

TEST_P(BuiltinSceneTest, TrianglesAreWoundAsTheirNormalsPointAndHaveArea) {
  const Scene scene = load_scene(GetParam());
  for (const Mesh& mesh : scene.meshes) {
    size_t inward = 0, flat = 0;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      flat += glm::length(normal) < 1e-9;
      inward += glm::dot(normal, glm::dvec3(mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z])) <= 0.0;
    }
    EXPECT_EQ(flat, 0u) << mesh.name;
    EXPECT_EQ(inward, 0u) << mesh.name;
  }
}

TEST_P(BuiltinSceneTest, TexturesShowSomethingAndUvsSpreadThem) {
  const Scene scene = load_scene(GetParam());
  EXPECT_FALSE(scene.textures.empty());
  for (const Texture& texture : scene.textures) {
    std::set<std::tuple<int, int, int>> colors;
    for (const glm::u8vec4& t : texture.texels) {
      if (colors.size() <= 8) colors.emplace(t.r, t.g, t.b);
    }
    EXPECT_GT(colors.size(), 8u) << texture.name;
  }
  for (const Mesh& mesh : scene.meshes) {
    if (scene.materials[static_cast<size_t>(mesh.material)].base_color_texture < 0) continue;
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size()) << mesh.name;
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec2 e1 = mesh.uvs[t.y] - mesh.uvs[t.x], e2 = mesh.uvs[t.z] - mesh.uvs[t.x];
      area += std::abs(e1.x * e2.y - e1.y * e2.x);
    }
    EXPECT_GT(area, 0.01) << mesh.name;
  }
}

TEST_P(BuiltinSceneTest, DefaultViewIsInsideTheSceneAndLit) {
  const Scene scene = load_scene(GetParam());
  const Bounds bounds = scene.bounds();
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(scene.default_from[i], bounds.min[i]);
    EXPECT_LT(scene.default_from[i], i == 1 ? bounds.max[i] + 100.0 : bounds.max[i]);
  }
  EXPECT_FALSE(scene.lights.empty());
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinSceneTest, ::testing::ValuesIn(all_scenes()), [](const auto& test) {
  std::string name = test.param;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

void expect_about(size_t count, double expected) {
  EXPECT_GE(static_cast<double>(count), 0.9 * expected);
  EXPECT_LE(static_cast<double>(count), 1.1 * expected);
}

TEST(BuiltinCity, HasThirtyFiveThousandTrianglesInFourteenMaterials) {
  const Scene city = load_scene("city");
  expect_about(city.triangle_count(), 35000);
  std::set<int> used;
  for (const Mesh& mesh : city.meshes) used.insert(mesh.material);
  EXPECT_EQ(used.size(), 14u);
  EXPECT_EQ(city.materials.size(), 14u);
}

TEST(BuiltinCity, GrowsToThreePointTwoMillionInLessThan300Megabytes) {
  const Scene city = load_scene("city:blocks=57");
  expect_about(city.triangle_count(), 3.2e6);
  size_t bytes = 0, largest = 0;
  for (const Mesh& mesh : city.meshes) {
    bytes += mesh.positions.size() * (12 + 12 + 8 + 4) + mesh.triangles.size() * 12;
    largest = std::max(largest, mesh.triangles.size());
  }
  EXPECT_LT(bytes, 300'000'000u);
  EXPECT_LT(largest, 20'000u) << "a mesh should be one neighbourhood";
}

TEST(BuiltinCity, ConsecutiveTrianglesAreNeighbours) {
  const Scene city = load_scene("city");
  size_t count = 0, far_apart = 0;
  for (const Mesh& mesh : city.meshes) {
    for (size_t i = 1; i < mesh.triangles.size(); ++i) {
      ++count;
      far_apart += glm::distance(mesh.positions[mesh.triangles[i].x], mesh.positions[mesh.triangles[i - 1].x]) > 100.0f;
    }
  }
  EXPECT_LT(far_apart, count / 50);
}

TEST(BuiltinScenes, HaveTheCountsTheyAreKnownFor) {
  expect_about(load_scene("temple").triangle_count(), 4000);
  expect_about(load_scene("facade:detail=0").triangle_count(), 600);
  expect_about(load_scene("facade:detail=1").triangle_count(), 2800);
  expect_about(load_scene("facade:detail=2").triangle_count(), 4900);
  for (const int count : {120000, 500000, 2000000}) {
    expect_about(load_scene("terrain:triangles=" + std::to_string(count)).triangle_count(), count);
  }
}

TEST(BuiltinScenes, SeedsChangeTheScene) {
  EXPECT_NE(load_scene("city:seed=1").triangle_count(), load_scene("city:seed=2").triangle_count());
  EXPECT_NE(load_scene("terrain:triangles=1000,seed=1").meshes[0].positions,
            load_scene("terrain:triangles=1000,seed=2").meshes[0].positions);
}

TEST(BuiltinTemple, PlacesOneColumnThirtyTimes) {
  const Scene temple = load_scene("temple");
  std::map<int, int> uses;
  for (const Instance& instance : temple.instances) ++uses[instance.mesh];
  EXPECT_EQ(uses[0], 30);
  EXPECT_EQ(temple.meshes[0].name, "column");
}

using Edge = std::array<float, 6>;

/// How often each directed edge occurs, by position; a closed hull has each edge once in both directions.
size_t unmatched_edges(const Scene& scene, std::span<const int> objects, const std::set<std::string>& names) {
  std::map<Edge, int> edges;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    if (std::find(objects.begin(), objects.end(), instance.object) == objects.end() || !names.contains(mesh.name))
      continue;
    for (const glm::uvec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        const glm::vec3 a = mesh.positions[t[k]] + 0.0f, b = mesh.positions[t[(k + 1) % 3]] + 0.0f;
        ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
        --edges[{b.x, b.y, b.z, a.x, a.y, a.z}];
      }
    }
  }
  EXPECT_FALSE(edges.empty());
  return static_cast<size_t>(
      std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second != 0; }));
}

TEST(BuiltinRoom, HullIsWatertightAndOfTwelveTriangles) {
  const Scene room = load_scene("room");
  const int hull[] = {0};
  EXPECT_EQ(unmatched_edges(room, hull, {"walls and ceiling", "floor"}), 0u);
  EXPECT_EQ(room.meshes[0].triangles.size() + room.meshes[1].triangles.size(), 12u);
}

TEST(BuiltinRoom, BallRingAndPotAreWatertight) {
  const Scene room = load_scene("room");
  for (const Instance& instance : room.instances) {
    const std::string& name = room.meshes[static_cast<size_t>(instance.mesh)].name;
    if (name != "ball" && name != "ring" && name != "pot") continue;
    const int object[] = {instance.object};
    EXPECT_EQ(unmatched_edges(room, object, {name}), 0u) << name;
  }
}

TEST(BuiltinTerrain, TilesMeetWithoutAGap) {
  const Scene terrain = load_scene("terrain:triangles=40000");
  std::vector<int> objects;
  std::set<std::string> names;
  for (const Instance& instance : terrain.instances) objects.push_back(instance.object);
  for (const Mesh& mesh : terrain.meshes) names.insert(mesh.name);
  EXPECT_GT(terrain.meshes.size(), 1u);
  const size_t side = 141;  // round(sqrt(40000 / 2)); only the four outer borders are open, both directions counted
  EXPECT_EQ(unmatched_edges(terrain, objects, names), 2 * 4 * side);
}

TEST(LoadScene, NamesWhatIsWrongInTheText) {
  const auto message = [](const char* text) {
    try {
      load_scene(text);
    } catch (const CommandError& error) {
      return std::string(error.what());
    }
    ADD_FAILURE() << text << " was accepted";
    return std::string();
  };
  EXPECT_NE(message("citty").find("did you mean 'city'"), std::string::npos);
  EXPECT_NE(message("city:block=3").find("did you mean 'blocks'"), std::string::npos);
  EXPECT_NE(message("city:blocks=65").find("between 1 and 64"), std::string::npos);
  EXPECT_NE(message("city:blocks=1.5").find("blocks"), std::string::npos);
  EXPECT_NE(message("facade:detail=3").find("between 0 and 2"), std::string::npos);
  EXPECT_NE(message("room:blocks=3").find("blocks"), std::string::npos);
  message("");
}

}  // namespace
}  // namespace omma
