#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "omma/base/error.h"
#include "omma/scene/scene.h"

namespace omma {
namespace {

Mesh one_triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// A node that turns a quarter around y in two seconds and moves along x, with a child one metre along its -Z.
Scene turning_scene() {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes.push_back(one_triangle());
  scene.nodes.resize(2);
  scene.nodes[1].parent = 0;
  scene.nodes[1].translation = {0, 0, -1};
  Instance instance;
  instance.node = 1;
  scene.instances.push_back(instance);
  NodeAnimation moved;
  moved.node = 0;
  moved.rotation.times = {0.0, 2.0};
  moved.rotation.values = {glm::dquat(1, 0, 0, 0), glm::angleAxis(glm::half_pi<double>(), glm::dvec3(0, 1, 0))};
  moved.translation.times = {0.0, 1.0, 4.0};
  moved.translation.values = {{0, 0, 0}, {10, 0, 0}, {10, 0, 0}};
  Animation turn;
  turn.name = "turn";
  turn.duration = 4.0;
  turn.nodes.push_back(moved);
  scene.animations.push_back(turn);
  finish_scene(scene);
  return scene;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " for " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(SetTime, TurnsSphericallyAndMovesLinearly) {
  Scene scene = turning_scene();
  const auto origin = [&] { return glm::dvec3(scene.instances[0].worldFromObject[3]); };
  expect_near(origin(), {0, 0, -1}, 1e-15);
  set_time(scene, 1.0);  // 45 degrees, by hand: -Z turned left
  expect_near(origin(), {10.0 - std::sqrt(0.5), 0, -std::sqrt(0.5)}, 1e-12);
  set_time(scene, 0.5);
  expect_near(origin(), {5.0 - std::sin(glm::pi<double>() / 8), 0, -std::cos(glm::pi<double>() / 8)}, 1e-12);
}

TEST(SetTime, HoldsOutsideKeysAndWrapsAtTheEnd) {
  Scene scene = turning_scene();
  set_time(scene, 3.0);
  expect_near(glm::dvec3(scene.instances[0].worldFromObject[3]), {9, 0, 0}, 1e-12);
  for (const double time : {4.0, 400.0, -4.0}) {
    set_time(scene, time);
    expect_near(glm::dvec3(scene.instances[0].worldFromObject[3]), {0, 0, -1}, 1e-12);
  }
  set_time(scene, -3.0);
  expect_near(glm::dvec3(scene.nodes[0].worldFromNode[3]), {10, 0, 0}, 1e-12);
}

TEST(SetTime, StepsWhereKeysSayStep) {
  Scene scene = turning_scene();
  scene.animations[0].nodes[0].translation.step = true;
  set_time(scene, 0.999);
  EXPECT_EQ(scene.nodes[0].worldFromNode[3].x, 0.0);
  set_time(scene, 1.0);
  EXPECT_EQ(scene.nodes[0].worldFromNode[3].x, 10.0);
}

TEST(SetTime, LightsAndCamerasFollowTheirNodesWithoutScale) {
  Scene scene = turning_scene();
  scene.nodes[1].scale = {3.0, 0.5, 2.0};
  Light light;
  light.kind = Light::Kind::spot;
  light.node = 1;
  scene.lights.push_back(light);
  SceneCamera camera;
  camera.node = 1;
  scene.cameras.push_back(camera);
  set_time(scene, 2.0);
  expect_near(scene.lights[0].position, {9, 0, 0}, 1e-12);
  expect_near(scene.lights[0].direction, {-1, 0, 0}, 1e-12);
  const glm::dmat4 pose = scene.cameras[0].worldFromCamera;
  expect_near(glm::dvec3(pose[0]), {0, 0, -1}, 1e-12);
  expect_near(glm::dvec3(pose[1]), {0, 1, 0}, 1e-12);
  expect_near(glm::dvec3(pose[3]), {9, 0, 0}, 1e-12);
}

TEST(SetTime, BlendsJointsByTheirWeights) {
  Scene scene = turning_scene();
  Mesh& mesh = scene.meshes[0];
  Skin skin;
  // Joint 0 is the still root frame of the mesh's bind pose; joint 1 is the node that moves.
  scene.nodes.push_back(Node{});
  skin.joints = {{2, glm::dmat4(1.0)}, {0, glm::dmat4(1.0)}};
  skin.vertex_joints = {{0, 1, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}};
  skin.vertex_weights = {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {0, 0, 0, 0}};
  mesh.skin = skin;
  finish_scene(scene);
  set_time(scene, 2.0);
  expect_near(mesh.positions[0], {0, 0, 0}, 1e-6);
  // Half of (1,0,0) and half of (10,0,-1), the quarter turn and the move of (1,0,0).
  expect_near(mesh.positions[1], {5.5, 0, -0.5}, 1e-6);
  // Nothing holds the third vertex but its node, which is at (9,0,0) turned a quarter.
  expect_near(mesh.positions[2], {9, 1, 0}, 1e-6);
  EXPECT_EQ(scene.instances[0].worldFromObject, glm::dmat4(1.0));
  // Normal (0,0,1): kept, halfway to (1,0,0), turned to (1,0,0).
  expect_near(mesh.normals[0], {0, 0, 1}, 1e-6);
  expect_near(mesh.normals[1], glm::normalize(glm::dvec3(1, 0, 1)), 1e-6);
  expect_near(mesh.normals[2], {1, 0, 0}, 1e-6);
  set_time(scene, 0.0);
  expect_near(mesh.positions[1], {1, 0, 0}, 1e-6);
}

TEST(SetTime, MorphsByAnimatedOrDefaultWeights) {
  Scene scene = turning_scene();
  MorphTarget target;
  target.position_offsets.assign(3, {0, 2, 0});
  target.weight = 0.25f;
  scene.meshes[0].morph_targets.push_back(target);
  finish_scene(scene);
  expect_near(scene.meshes[0].positions[1], {1, 0.5, 0}, 1e-6);
  MorphAnimation morph;
  morph.node = 1;
  morph.weights.times = {0.0, 2.0};
  morph.weights.values = {{0.0f}, {1.0f}};
  scene.animations[0].morphs.push_back(morph);
  set_time(scene, 1.0);
  expect_near(scene.meshes[0].positions[1], {1, 1, 0}, 1e-6);
  set_time(scene, 2.0);
  set_time(scene, 2.0);  // from the rest pose each time, not on top of the last
  expect_near(scene.meshes[0].positions[1], {1, 2, 0}, 1e-6);
}

TEST(SetTime, RefusesNamesAndTimesThatDoNotExist) {
  Scene scene = turning_scene();
  EXPECT_THROW(set_time(scene, 0.0, "tern"), CommandError);
  EXPECT_THROW(set_time(scene, std::nan("")), CommandError);
  EXPECT_THROW(set_time(scene, INFINITY), CommandError);
  set_time(scene, 0.0, "turn");
  Scene still = load_scene("facade:detail=0");
  set_time(still, 12.0);
  EXPECT_THROW(set_time(still, 0.0, "turn"), CommandError);
}

TEST(Scene, CountsAndBoundsRunOverInstances) {
  Scene scene = turning_scene();
  Instance second = scene.instances[0];
  second.node = 0;
  second.object = 1;
  scene.instances.push_back(second);
  finish_scene(scene);
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.instances[1].first_triangle, 1u);
  expect_near(scene.bounds().min, {0, 0, -1}, 1e-12);
  expect_near(scene.bounds().max, {1, 1, 0}, 1e-12);
}

}  // namespace
}  // namespace omma
