// The ray tracer alone, without any GL: the sanitizers' way into it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "omma/oracle/embree_scene.h"

namespace omma {
namespace {

constexpr uint32_t none = ~0u;

/// A square of 2 x 2 at z, facing +Z: triangles lower right, upper left.
void add_pane(Scene& scene, double z, const Material& material, bool mirrored = false) {
  scene.materials.push_back(material);
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = int(scene.materials.size()) - 1;
  scene.meshes.push_back(mesh);
  Node node;
  node.translation = {0, 0, z};
  if (mirrored) node.scale = {-1, 1, 1};
  scene.nodes.push_back(node);
  Instance instance;
  instance.mesh = instance.node = instance.object = int(scene.meshes.size()) - 1;
  scene.instances.push_back(instance);
}

Scene make_panes(std::initializer_list<std::pair<double, Material>> panes) {
  Scene scene;
  for (const auto& [z, material] : panes) add_pane(scene, z, material);
  finish_scene(scene);
  return scene;
}

std::vector<RayHit> trace(const EmbreeScene& trees, const std::vector<glm::vec3>& directions, int width,
                          std::span<const glm::vec3> origins = {}, Solid solid = Solid::opaque) {
  std::vector<RayHit> hits(directions.size());
  trees.nearest(origins, directions, width, solid, hits);
  return hits;
}

TEST(EmbreeSceneTest, FindsTheNearestTriangleAndItsDistance) {
  const Scene scene = make_panes({{-3.0, {}}, {-2.0, {}}});
  EmbreeScene trees(scene);
  trees.set_view(glm::dmat4(1.0));
  const glm::vec3 slanted = glm::normalize(glm::vec3(0.3f, -0.2f, -1.0f));
  const auto hits = trace(trees, {{0, 0.01f, -1}, slanted, {0, 0, 1}}, 3);
  EXPECT_EQ(hits[0].triangle, 3u);  // the second pane's upper left
  EXPECT_EQ(hits[0].instance, 1u);
  EXPECT_EQ(hits[1].triangle, 2u);
  EXPECT_NEAR(hits[1].distance, 2.0f / -slanted.z, 1e-6f);
  EXPECT_EQ(hits[2].triangle, none);
  EXPECT_EQ(hits[2].instance, none);
  EXPECT_EQ(hits[2].distance, std::numeric_limits<float>::infinity());
}

TEST(EmbreeSceneTest, RaysMayStartAnywhereAndBeMissing) {
  const Scene scene = make_panes({{-2.0, {}}});
  EmbreeScene trees(scene);
  trees.set_view(glm::dmat4(1.0));
  // Rows of five, two of them: no multiple of the tracer's squares.
  std::vector<glm::vec3> directions(10, {0, 0, -1}), origins(10, glm::vec3(0.5f, 0.25f, 0.0f));
  directions[3] = directions[9] = glm::vec3(0.0f);
  origins[1] = {5, 0, 0};  // beside the pane
  origins[2] = {0.5f, 0.25f, 6};
  const auto hits = trace(trees, directions, 5, origins);
  for (size_t i = 0; i < hits.size(); ++i) {
    const bool expected = i != 1 && i != 3 && i != 9;
    EXPECT_EQ(hits[i].triangle != none, expected) << i;
    if (!expected) continue;
    EXPECT_NEAR(hits[i].distance, i == 2 ? 8.0f : 2.0f, 1e-5f) << i;
  }
}

TEST(EmbreeSceneTest, AnEmptySceneStopsNoRay) {
  const Scene scene;
  EmbreeScene trees(scene);
  trees.set_view(glm::dmat4(1.0));
  EXPECT_FALSE(trees.has_blending());
  for (const RayHit& hit : trace(trees, std::vector<glm::vec3>(7, {0, 0, -1}), 7)) EXPECT_EQ(hit.triangle, none);
  EXPECT_TRUE(trace(trees, {}, 7).empty());
}

TEST(EmbreeSceneTest, PassesBackFacesUnlessTwoSidedHoweverTheInstanceIsMirrored) {
  for (const bool double_sided : {false, true}) {
    for (const bool mirrored : {false, true}) {
      Scene scene;
      Material material;
      material.double_sided = double_sided;
      add_pane(scene, -2.0, material, mirrored);
      add_pane(scene, 2.0, material, mirrored);  // behind the camera, its back towards it
      finish_scene(scene);
      EmbreeScene trees(scene);
      trees.set_view(glm::dmat4(1.0));
      const auto hits = trace(trees, {{0.1f, 0, -1}, {0.1f, 0, 1}}, 2);
      EXPECT_NE(hits[0].triangle, none);
      EXPECT_EQ(hits[1].triangle != none, double_sided);
    }
  }
}

TEST(EmbreeSceneTest, PassesHolesOfMaskedTextures) {
  Scene scene;
  Texture half;  // its left texel is a hole
  half.width = 2;
  half.height = 1;
  half.wrap_u = half.wrap_v = Texture::Wrap::clamp;
  half.texels = {{255, 255, 255, 0}, {255, 255, 255, 255}};
  scene.textures.push_back(half);
  Material masked;
  masked.alpha = Material::Alpha::mask;
  masked.base_color_texture = 0;
  add_pane(scene, -1.0, masked);
  add_pane(scene, -2.0, {});
  finish_scene(scene);
  EmbreeScene trees(scene);
  trees.set_view(glm::dmat4(1.0));
  const auto hits =
      trace(trees, {glm::normalize(glm::vec3(-0.4f, 0.1f, -1)), glm::normalize(glm::vec3(0.4f, 0.1f, -1))}, 2);
  EXPECT_EQ(hits[0].instance, 1u);
  EXPECT_EQ(hits[1].instance, 0u);
}

TEST(EmbreeSceneTest, BlendedSurfacesComeInOrderUpToTheLimit) {
  Material glass;
  glass.alpha = Material::Alpha::blend;
  glass.base_color.a = 0.3f;
  Material thick = glass;
  thick.base_color.a = 0.7f;
  const Scene scene = make_panes({{-4.0, {}}, {-3.0, thick}, {-5.0, glass}, {-2.0, glass}});
  EmbreeScene trees(scene);
  trees.set_view(glm::dmat4(1.0));
  EXPECT_TRUE(trees.has_blending());
  const std::vector<glm::vec3> directions{{0.1f, 0, -1}, {0, 0, 0}};
  const auto solid = trace(trees, directions, 2);
  EXPECT_EQ(solid[0].instance, 0u);
  const auto labels = trace(trees, directions, 2, {}, Solid::labels);
  EXPECT_EQ(labels[0].instance, 1u);  // the nearest that covers at least half
  const auto layers = trees.blended({}, directions, solid);
  ASSERT_EQ(layers.size(), 2u);
  ASSERT_EQ(layers[0].size(), 2u);  // the one behind the opaque pane is not there
  EXPECT_EQ(layers[0][0].instance, 3u);
  EXPECT_EQ(layers[0][1].instance, 1u);
  EXPECT_TRUE(layers[1].empty());
}

TEST(EmbreeSceneTest, LosesNothingFarFromTheOrigin) {
  const glm::dvec3 origin(3e6, -2e6, 1e6);
  Scene scene;
  add_pane(scene, -2.0, {});
  scene.nodes[0].translation += origin;
  finish_scene(scene);
  EmbreeScene trees(scene);
  trees.set_view(glm::translate(glm::dmat4(1.0), origin));
  const auto hits = trace(trees, {glm::normalize(glm::vec3(0.4f, 0.1f, -1))}, 1);
  ASSERT_NE(hits[0].triangle, none);
  EXPECT_NEAR(hits[0].distance, 2.0f * glm::length(glm::vec3(0.4f, 0.1f, -1)), 1e-5f);
}

TEST(EmbreeSceneTest, UpdateFollowsDeformedMeshes) {
  Scene scene;
  add_pane(scene, -2.0, {});
  MorphTarget target;
  target.position_offsets.assign(4, {0, 0, -3});
  scene.meshes[0].morph_targets.push_back(target);
  MorphAnimation morph;
  morph.weights = {{0.0, 1.0}, {{0.0f}, {1.0f}}};
  Animation animation;
  animation.duration = 1.0;
  animation.morphs.push_back(morph);
  scene.animations.push_back(animation);
  finish_scene(scene);
  EmbreeScene trees(scene);
  trees.update(set_time(scene, 0.5));
  trees.set_view(glm::dmat4(1.0));
  const auto hits = trace(trees, {{0.1f, 0, -1}}, 1);
  EXPECT_NEAR(hits[0].distance, 3.5f, 1e-5f);
}

}  // namespace
}  // namespace omma
