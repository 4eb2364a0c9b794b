#include "omma/visibility/cluster.h"

#include <cmath>

#include "omma/visibility/area_tree.h"

namespace omma {
namespace {

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool is_finite(const Mesh& mesh, uint32_t triangle) {
  const glm::uvec3& corner = mesh.triangles[triangle];
  return is_finite(mesh.positions[corner.x]) && is_finite(mesh.positions[corner.y]) &&
         is_finite(mesh.positions[corner.z]);
}

Box box_of(const Mesh& mesh, uint32_t triangle) {
  Box box;
  for (int c = 0; c < 3; ++c) box.add(mesh.positions[mesh.triangles[triangle][c]]);
  return box;
}

}  // namespace

Box Cluster::fill(const Mesh& mesh) {
  Box box;
  for (uint32_t lane = 0; lane < size; ++lane) {
    const bool used = triangle[lane] != unused && is_finite(mesh, triangle[lane]);
    if (used) box.add(box_of(mesh, triangle[lane]));
    for (int c = 0; c < 3; ++c) {
      const glm::vec3 p = used ? mesh.positions[mesh.triangles[triangle[lane]][c]] : glm::vec3(0.0f);
      for (int axis = 0; axis < 3; ++axis) corner[c][axis][lane] = p[axis];
    }
  }
  return box.min.x <= box.max.x ? box : Box{glm::vec3(0.0f), glm::vec3(0.0f)};
}

std::vector<TriangleGroup> group_triangles(const Mesh& mesh) {
  std::vector<uint32_t> triangles;
  std::vector<Box> boxes;
  triangles.reserve(mesh.triangles.size());
  boxes.reserve(mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_finite(mesh, t)) continue;
    triangles.push_back(t);
    boxes.push_back(box_of(mesh, t));
  }
  std::vector<TriangleGroup> groups;
  if (boxes.empty()) return groups;
  const AreaTree tree(boxes, Cluster::size);
  const auto add_leaves = [&](const auto& self, const AreaTree::Part& part) -> void {
    if (part.left) {
      self(self, *part.left);
      self(self, *part.right);
      return;
    }
    TriangleGroup& group = groups.emplace_back();
    group.box = part.box;
    for (uint32_t lane = 0; lane < Cluster::size; ++lane) {
      group.triangle[lane] = lane < part.count ? triangles[tree.order[part.first + lane]] : Cluster::unused;
    }
  };
  add_leaves(add_leaves, *tree.root);
  return groups;
}

}  // namespace omma
