// A mesh's triangles in clusters of sixteen, one SIMD register, under a tree of boxes. Built once per mesh and shared
// by its instances; when vertices move the boxes follow and nothing is built again.
#pragma once

#include <cstdint>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/box_tree.h"

namespace omma {

struct alignas(64) Cluster {
  static constexpr uint32_t size = 16;
  float corner[3][3][size];  ///< [corner][axis][triangle], in the mesh's own frame; unused triangles are zero
  uint32_t triangle[size];   ///< its number in the mesh
};

class MeshTree {
 public:
  /// Triangles with a corner that is not finite are left out.
  explicit MeshTree(const Mesh& mesh);
  /// Takes over the positions of the mesh it was built for, deformed since.
  void refit(const Mesh& mesh);

  const BoxTree& tree() const { return tree_; }
  const std::vector<Cluster>& clusters() const { return clusters_; }  ///< by the tree's leaves
  const Box& bounds() const { return bounds_; }
  size_t bytes() const { return tree_.nodes.size() * sizeof(BoxNode) + clusters_.size() * sizeof(Cluster); }

 private:
  void fill_clusters(const Mesh& mesh);

  BoxTree tree_;
  std::vector<Cluster> clusters_;
  std::vector<Box> cluster_boxes_;
  Box bounds_;
};

}  // namespace omma
