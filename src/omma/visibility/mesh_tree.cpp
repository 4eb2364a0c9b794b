#include "omma/visibility/mesh_tree.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace omma {
namespace {

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Box box_of(const Mesh& mesh, uint32_t triangle) {
  Box box;
  for (int c = 0; c < 3; ++c) box.add(mesh.positions[mesh.triangles[triangle][c]]);
  return box;
}

bool is_finite(const Mesh& mesh, uint32_t triangle) {
  const glm::uvec3& corner = mesh.triangles[triangle];
  return is_finite(mesh.positions[corner.x]) && is_finite(mesh.positions[corner.y]) &&
         is_finite(mesh.positions[corner.z]);
}

}  // namespace

MeshTree::MeshTree(const Mesh& mesh) {
  std::vector<uint32_t> triangles;
  std::vector<Box> boxes;
  triangles.reserve(mesh.triangles.size());
  boxes.reserve(mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_finite(mesh, t)) continue;
    triangles.push_back(t);
    boxes.push_back(box_of(mesh, t));
  }
  tree_ = build_box_tree(boxes, Cluster::size);
  clusters_.resize(tree_.leaves.size());
  cluster_boxes_.resize(tree_.leaves.size());
  for (size_t i = 0; i < clusters_.size(); ++i) {
    const BoxTree::Leaf& leaf = tree_.leaves[i];
    for (uint32_t lane = 0; lane < leaf.count; ++lane) {
      clusters_[i].triangle[lane] = triangles[tree_.order[leaf.first + lane]];
    }
  }
  fill_clusters(mesh);
}

void MeshTree::refit(const Mesh& mesh) {
  fill_clusters(mesh);
  tree_.refit(cluster_boxes_);
}

void MeshTree::fill_clusters(const Mesh& mesh) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, clusters_.size(), 256), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      Cluster& cluster = clusters_[i];
      cluster_boxes_[i] = {};
      for (uint32_t lane = 0; lane < Cluster::size; ++lane) {
        // A triangle that deformed into nowhere becomes a point, which no ray meets.
        const bool used = lane < tree_.leaves[i].count && is_finite(mesh, cluster.triangle[lane]);
        if (used) cluster_boxes_[i].add(box_of(mesh, cluster.triangle[lane]));
        for (int c = 0; c < 3; ++c) {
          const glm::vec3 p = used ? mesh.positions[mesh.triangles[cluster.triangle[lane]][c]] : glm::vec3(0.0f);
          for (int axis = 0; axis < 3; ++axis) cluster.corner[c][axis][lane] = p[axis];
        }
      }
      if (cluster_boxes_[i].min.x > cluster_boxes_[i].max.x) cluster_boxes_[i] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    }
  });
  bounds_ = {};
  for (const Box& box : cluster_boxes_) bounds_.add(box);
}

}  // namespace omma
