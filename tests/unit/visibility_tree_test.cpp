// Trees of boxes and of a mesh's triangles: complete, tight, and refitted as if they were built anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "omma/visibility/mesh_tree.h"

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

/// Every node's boxes hold what is below them; returns how often each triangle of the mesh was met.
std::vector<int> check(const MeshTree& tree, const Mesh& mesh) {
  std::vector<int> met(mesh.triangles.size());
  size_t outside = 0;
  std::vector<std::pair<uint32_t, Box>> open;
  if (!tree.tree().nodes.empty()) open.emplace_back(0, tree.bounds());
  while (!open.empty()) {
    const auto [number, around] = open.back();
    open.pop_back();
    const BoxNode& node = tree.tree().nodes[number];
    EXPECT_GE(node.count, 1u);
    for (uint32_t lane = 0; lane < node.count; ++lane) {
      if (!(node.child[lane] & BoxNode::leaf)) {
        open.emplace_back(node.child[lane], node.box(lane));
        continue;
      }
      const uint32_t leaf = node.child[lane] & ~BoxNode::leaf;
      const Cluster& cluster = tree.clusters()[leaf];
      for (uint32_t t = 0; t < tree.tree().leaves[leaf].count; ++t) {
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

TEST(MeshTreeTest, HoldsEveryTriangleOnceWithinItsBoxes) {
  for (const size_t count : {0, 1, 15, 16, 17, 100, 257, 20000}) {
    const Mesh mesh = random_mesh(count, 3);
    const MeshTree tree(mesh);
    const std::vector<int> met = check(tree, mesh);
    EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; })) << count;
    // Lanes are not wasted.
    EXPECT_LE(tree.clusters().size(), count / 16 + 1 + count / 64);
  }
}

TEST(MeshTreeTest, PutsUpWithTrianglesAtOnePlaceAndWithHugeOnes) {
  Mesh mesh = random_mesh(1000, 5);
  for (size_t i = 0; i < 1500; ++i) mesh.positions[i] = glm::vec3(1, 2, 3);
  mesh.positions[2000] = glm::vec3(3e38f);
  mesh.positions[2300] = glm::vec3(-3e38f);
  mesh.positions[2600] = glm::vec3(std::numeric_limits<float>::infinity());
  mesh.positions[2900] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const std::vector<int> met = check(MeshTree(mesh), mesh);
  for (size_t t = 0; t < met.size(); ++t) EXPECT_EQ(met[t], t != 2600 / 3 && t != 2900 / 3) << t;
}

TEST(MeshTreeTest, FollowsDeformation) {
  Mesh mesh = random_mesh(3000, 7);
  MeshTree tree(mesh);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(p.y * 2.0f, p.x - 100.0f, p.z * p.z * 0.01f);
  tree.refit(mesh);
  const std::vector<int> met = check(tree, mesh);
  EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
  const MeshTree fresh(mesh);
  EXPECT_EQ(tree.bounds().min, fresh.bounds().min);
  EXPECT_EQ(tree.bounds().max, fresh.bounds().max);
}

}  // namespace
}  // namespace omma
