// Bodies and their trees of boxes: complete, tight, and refitted when vertices move.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "omma/visibility/bodies.h"

namespace omma {
namespace {

bool contains(const Box& box, const glm::vec3& p) {
  return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
}

Mesh random_mesh(size_t triangles, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> place(0.0f, 50.0f), size(0.0f, 1.0f);
  Mesh mesh;
  for (uint32_t t = 0; t < triangles; ++t) {
    const glm::vec3 middle(place(random), place(random), place(random));
    for (int c = 0; c < 3; ++c) mesh.positions.push_back(middle + glm::vec3(size(random), size(random), size(random)));
    mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  }
  return mesh;
}

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

/// Every node's boxes hold what is below them; returns how often each triangle of the mesh was met.
std::vector<int> check(const Body& body, const Mesh& mesh) {
  std::vector<int> met(mesh.triangles.size());
  size_t outside = 0;
  std::vector<std::pair<uint32_t, Box>> open;
  if (!body.tree.nodes.empty()) open.emplace_back(0, body.bounds);
  while (!open.empty()) {
    const auto [number, around] = open.back();
    open.pop_back();
    const BoxNode& node = body.tree.nodes[number];
    EXPECT_GE(node.count, 1u);
    for (uint32_t lane = 0; lane < node.count; ++lane) {
      if (!(node.child[lane] & BoxNode::leaf)) {
        open.emplace_back(node.child[lane], node.box(lane));
        continue;
      }
      const Cluster& cluster = body.clusters[node.child[lane] & ~BoxNode::leaf];
      for (uint32_t t = 0; t < Cluster::size; ++t) {
        if (cluster.triangle[t] == Cluster::unused) continue;
        ++met[cluster.triangle[t]];
        for (int c = 0; c < 3; ++c) {
          const glm::vec3 p = mesh.positions[mesh.triangles[cluster.triangle[t]][c]];
          outside += !contains(node.box(lane), p) || !contains(around, p);
          outside += p != glm::vec3(cluster.corner[c][0][t], cluster.corner[c][1][t], cluster.corner[c][2][t]);
        }
      }
    }
  }
  EXPECT_EQ(outside, 0u);
  return met;
}

TEST(BodyTest, HoldsEveryTriangleOnceWithinItsBoxes) {
  for (const size_t count : {0, 1, 15, 16, 17, 100, 257, 20000, 200000}) {
    const Scene scene = scene_of(random_mesh(count, 3));
    const std::vector<int> met = check(Body(scene, {0}), scene.meshes[0]);
    EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; })) << count;
  }
}

TEST(BodyTest, IsTheSameOnOneCore) {
  const Scene scene = scene_of(random_mesh(200000, 9));
  const Body body(scene, {0});
  tbb::task_arena(1).execute([&] {
    const Body alone(scene, {0});
    EXPECT_EQ(body.tree.order, alone.tree.order);
    ASSERT_EQ(body.clusters.size(), alone.clusters.size());
    for (size_t i = 0; i < body.clusters.size(); ++i) {
      ASSERT_TRUE(
          std::equal(body.clusters[i].triangle, body.clusters[i].triangle + Cluster::size, alone.clusters[i].triangle));
    }
  });
}

TEST(BodyTest, WastesNoLanesOnASurface) {
  constexpr uint32_t side = 100;
  Mesh mesh;
  for (uint32_t y = 0; y <= side; ++y) {
    for (uint32_t x = 0; x <= side; ++x) {
      mesh.positions.emplace_back(x, y, std::sin(0.1f * float(x)) * std::cos(0.15f * float(y)));
      const uint32_t corner = y * (side + 1) + x;
      if (x == side || y == side) continue;
      mesh.triangles.emplace_back(corner, corner + 1, corner + side + 2);
      mesh.triangles.emplace_back(corner, corner + side + 2, corner + side + 1);
    }
  }
  EXPECT_LT(group_triangles(mesh).size(), 2 * side * side / 16 * 5 / 4);
}

TEST(BodyTest, PutsUpWithTrianglesAtOnePlaceAndWithHugeOnes) {
  Mesh mesh = random_mesh(1000, 5);
  for (size_t i = 0; i < 1500; ++i) mesh.positions[i] = glm::vec3(1, 2, 3);
  mesh.positions[2000] = glm::vec3(3e38f);
  mesh.positions[2300] = glm::vec3(-3e38f);
  mesh.positions[2600] = glm::vec3(std::numeric_limits<float>::infinity());
  mesh.positions[2900] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const Scene scene = scene_of(mesh);
  const std::vector<int> met = check(Body(scene, {0}), mesh);
  for (size_t t = 0; t < met.size(); ++t) EXPECT_EQ(met[t], t != 2600 / 3 && t != 2900 / 3) << t;
}

TEST(BodyTest, FollowsDeformation) {
  Scene scene = scene_of(random_mesh(3000, 7));
  Mesh& mesh = scene.meshes[0];
  Body body(scene, {0});
  for (glm::vec3& p : mesh.positions) p = glm::vec3(p.y * 2.0f, p.x - 100.0f, p.z * p.z * 0.01f);
  body.refit(scene);
  const std::vector<int> met = check(body, mesh);
  EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
}

/// Instances of the meshes, all at one place.
Scene scene_with(const std::vector<int>& meshes) {
  Scene scene;
  scene.materials.emplace_back();
  for (int m = 0; m <= *std::max_element(meshes.begin(), meshes.end()); ++m) {
    scene.meshes.push_back(random_mesh(50, unsigned(m)));
  }
  for (const int mesh : meshes) {
    scene.nodes.emplace_back();
    Instance instance;
    instance.mesh = mesh;
    instance.node = instance.object = int(scene.instances.size());
    scene.instances.push_back(instance);
  }
  finish_scene(scene);
  return scene;
}

/// Checks that each instance stands at just one place, as the scene says. Returns how many are gone from bodies.
size_t expect_all_placed(const Scene& scene, const Bodies& bodies) {
  std::vector<int> placed(scene.instances.size());
  size_t gone = 0;
  for (const Placement& placement : bodies.placements()) {
    const Body& body = bodies.bodies()[placement.body];
    EXPECT_EQ(placement.instances.size(), body.meshes.size());
    for (size_t i = 0; i < placement.instances.size(); ++i) {
      if (placement.instances[i] == Placement::gone) {
        ++gone;
        continue;
      }
      const Instance& instance = scene.instances[placement.instances[i]];
      ++placed[placement.instances[i]];
      EXPECT_EQ(instance.mesh, body.meshes[i]);
      EXPECT_EQ(instance.worldFromObject, placement.worldFromBody);
    }
  }
  EXPECT_EQ(placed, std::vector<int>(scene.instances.size(), 1));
  return gone;
}

TEST(BodiesTest, WhatStandsTogetherIsOneBodyUntilItPartsWays) {
  Scene scene = scene_with({0, 1, 2, 2});
  Bodies bodies(scene);
  EXPECT_EQ(bodies.bodies().size(), 2u);      // the first two meshes, and the third
  EXPECT_EQ(bodies.placements().size(), 3u);  // the third twice
  const auto move = [](Instance& instance) { instance.worldFromObject[3].x += 1.0; };
  move(scene.instances[0]);
  move(scene.instances[1]);
  bodies.update({.moved = true});
  // More than half of what stood together has moved away from there.
  EXPECT_EQ(expect_all_placed(scene, bodies), 0u);
  EXPECT_EQ(bodies.placements().size(), 4u);
  move(scene.instances[1]);
  bodies.update({.moved = true});
  EXPECT_EQ(expect_all_placed(scene, bodies), 0u);
}

TEST(BodiesTest, OneThatLeavesManyLeavesAGap) {
  Scene scene = scene_with({0, 1, 2, 3, 4, 5, 6, 7});
  Bodies bodies(scene);
  ASSERT_EQ(bodies.bodies().size(), 1u);
  const Body* together = bodies.bodies().data();
  const std::vector<uint32_t> tags = together->part;
  scene.instances[3].worldFromObject[3].y = 2.0;
  bodies.update({.moved = true});
  EXPECT_EQ(expect_all_placed(scene, bodies), 1u);
  EXPECT_EQ(bodies.bodies().size(), 2u);
  scene.instances.erase(scene.instances.begin());
  bodies.update({.listed = true});
  EXPECT_EQ(expect_all_placed(scene, bodies), 2u);
  EXPECT_EQ(bodies.bodies().size(), 2u);
  EXPECT_EQ(bodies.bodies().front().part, tags);  // it was not sorted anew
  scene.instances[2].worldFromObject[3].y = 0.0;
  bodies.update({.moved = true});
  EXPECT_EQ(expect_all_placed(scene, bodies), 1u);  // it is back
}

}  // namespace
}  // namespace omma
