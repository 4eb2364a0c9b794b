#include "omma/visibility/bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace omma {

Body::Body(const Scene& scene, std::vector<int> of_meshes) : meshes(std::move(of_meshes)) {
  std::vector<std::vector<TriangleGroup>> groups(meshes.size());
  tbb::parallel_for(size_t{0}, meshes.size(),
                    [&](size_t i) { groups[i] = group_triangles(scene.meshes[size_t(meshes[i])]); });
  std::vector<Box> boxes;
  std::vector<std::pair<uint32_t, uint32_t>> places;  // mesh, group
  for (uint32_t i = 0; i < meshes.size(); ++i) {
    for (uint32_t j = 0; j < groups[i].size(); ++j) {
      boxes.push_back(groups[i][j].box);
      places.emplace_back(i, j);
    }
  }
  tree = build_box_tree(boxes, 1);
  // In the tree's order neighbours are near to each other in memory, too.
  clusters.resize(tree.leaves.size());
  part.resize(tree.leaves.size());
  tbb::parallel_for(size_t{0}, clusters.size(), [&](size_t leaf) {
    const auto [mesh, group] = places[tree.order[tree.leaves[leaf].first]];
    part[leaf] = mesh;
    std::copy_n(groups[mesh][group].triangle, Cluster::size, clusters[leaf].triangle);
    clusters[leaf].fill(scene.meshes[size_t(meshes[mesh])]);
  });
  for (BoxNode& node : tree.nodes) {
    for (uint32_t lane = 0; lane < node.count; ++lane) {
      if (node.child[lane] & BoxNode::leaf) node.tag[lane] = part[node.child[lane] & ~BoxNode::leaf];
    }
  }
  if (!tree.nodes.empty()) bounds = tree.nodes.front().bounds();
}

void Body::refit(const Scene& scene) {
  std::vector<Box> boxes(clusters.size());
  tbb::parallel_for(size_t{0}, clusters.size(),
                    [&](size_t i) { boxes[i] = clusters[i].fill(scene.meshes[size_t(meshes[part[i]])]); });
  tree.refit(boxes);
  if (!tree.nodes.empty()) bounds = tree.nodes.front().bounds();
}

Bodies::Bodies(const Scene& scene) : scene_(&scene), moves_(scene.instances.size(), false) { group(); }

void Bodies::group() {
  std::vector<std::vector<uint32_t>> users(scene_->meshes.size());
  grouped_at_.clear();
  for (uint32_t i = 0; i < scene_->instances.size(); ++i) {
    users[size_t(scene_->instances[i].mesh)].push_back(i);
    grouped_at_.push_back(scene_->instances[i].worldFromObject);
  }
  std::vector<std::vector<int>> meshes;  // of the bodies
  std::vector<Placement> together;
  placements_.clear();
  for (size_t m = 0; m < users.size(); ++m) {
    if (users[m].empty() || scene_->meshes[m].triangles.empty()) continue;
    const Instance& first = scene_->instances[users[m].front()];
    if (users[m].size() > 1 || moves_[users[m].front()]) {
      for (const uint32_t instance : users[m]) placements_.push_back({meshes.size(), {instance}});
      meshes.push_back({int(m)});
      continue;
    }
    // Blended surfaces are looked for on their own.
    const auto is_blended = [&](int mesh) {
      return scene_->materials[size_t(scene_->meshes[size_t(mesh)].material)].alpha == Material::Alpha::blend;
    };
    const auto found = std::find_if(together.begin(), together.end(), [&](const Placement& placement) {
      const Instance& other = scene_->instances[placement.instances.front()];
      return other.worldFromObject == first.worldFromObject && is_blended(other.mesh) == is_blended(int(m));
    });
    if (found == together.end()) {
      together.push_back({meshes.size(), {users[m].front()}});
      meshes.push_back({int(m)});
    } else {
      found->instances.push_back(users[m].front());
      meshes[found->body].push_back(int(m));
    }
  }
  placements_.insert(placements_.end(), together.begin(), together.end());
  bodies_.clear();
  for (std::vector<int>& of_body : meshes) bodies_.emplace_back(*scene_, std::move(of_body));
  // Nothing is left of a mesh of which no triangle is finite.
  std::erase_if(placements_, [&](const Placement& placement) { return bodies_[placement.body].clusters.empty(); });
}

void Bodies::update() {
  bool fell_apart = false;
  for (const Placement& placement : placements_) {
    const glm::dmat4& first = scene_->instances[placement.instances.front()].worldFromObject;
    const bool together = std::all_of(placement.instances.begin(), placement.instances.end(), [&](uint32_t instance) {
      return scene_->instances[instance].worldFromObject == first;
    });
    if (together) continue;
    fell_apart = true;
    for (const uint32_t instance : placement.instances) {
      if (scene_->instances[instance].worldFromObject != grouped_at_[instance]) moves_[instance] = true;
    }
  }
  if (fell_apart) return group();
  for (Body& body : bodies_) {
    const bool deforms = std::any_of(body.meshes.begin(), body.meshes.end(),
                                     [&](int mesh) { return scene_->meshes[size_t(mesh)].deforms(); });
    if (deforms) body.refit(*scene_);
  }
}

uint32_t Bodies::depth() const {
  uint32_t deepest = 0;
  for (const Body& body : bodies_) deepest = std::max(deepest, body.tree.depth);
  return deepest;
}

size_t Bodies::bytes() const {
  size_t sum = 0;
  for (const Body& body : bodies_) {
    sum += body.tree.nodes.size() * sizeof(BoxNode) + body.clusters.size() * (sizeof(Cluster) + sizeof(uint32_t)) +
           body.tree.leaves.size() * (sizeof(BoxTree::Leaf) + sizeof(uint32_t));
  }
  return sum;
}

}  // namespace omma
