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

Bodies::Bodies(const Scene& scene) : scene_(&scene) { group(); }

bool Bodies::is_blended(int mesh) const {
  return scene_->materials[size_t(scene_->meshes[size_t(mesh)].material)].alpha == Material::Alpha::blend;
}

size_t Bodies::body_of(int mesh) {
  own_.resize(scene_->meshes.size());
  std::optional<size_t>& own = own_[size_t(mesh)];
  if (!own) {
    own = bodies_.size();
    bodies_.emplace_back(*scene_, std::vector<int>{mesh});
  }
  return *own;
}

void Bodies::group() {
  std::vector<std::vector<uint32_t>> users(scene_->meshes.size());
  instance_of_key_.clear();
  for (uint32_t i = 0; i < scene_->instances.size(); ++i) {
    users[size_t(scene_->instances[i].mesh)].push_back(i);
    instance_of_key_.emplace(scene_->instances[i].key, i);
  }
  std::vector<std::vector<int>> meshes;  // of the bodies
  together_.clear();
  for (size_t m = 0; m < users.size(); ++m) {
    if (users[m].size() != 1 || scene_->meshes[m].triangles.empty()) continue;
    const Instance& instance = scene_->instances[users[m].front()];
    if (movers_.contains(instance.key) || lively_.contains(int(m))) continue;
    // Blended surfaces are looked for on their own.
    auto found = std::ranges::find_if(together_, [&](const Together& other) {
      return other.worldFromBody == instance.worldFromObject && other.blended == is_blended(int(m));
    });
    if (found == together_.end()) {
      together_.push_back({meshes.size(), instance.worldFromObject, is_blended(int(m)), {}});
      meshes.emplace_back();
      found = together_.end() - 1;
    }
    found->keys.push_back(instance.key);
    meshes[found->body].push_back(int(m));
  }
  bodies_.clear();
  own_.clear();
  own_.resize(scene_->meshes.size());
  for (std::vector<int>& of_body : meshes) {
    if (of_body.size() == 1) own_[size_t(of_body.front())] = bodies_.size();
    bodies_.emplace_back(*scene_, std::move(of_body));
  }
  place();
}

bool Bodies::stands_in(const Together& together, size_t part, uint32_t instance) const {
  const int mesh = bodies_[together.body].meshes[part];
  const Instance& there = scene_->instances[instance];
  return there.mesh == mesh && there.worldFromObject == together.worldFromBody &&
         is_blended(mesh) == together.blended && !lively_.contains(mesh);
}

bool Bodies::place() {
  placements_.clear();
  std::vector<bool> placed(scene_->instances.size(), false);
  size_t clusters = 0, gone = 0;
  for (const Together& together : together_) {
    const Body& body = bodies_[together.body];
    Placement placement{together.body, {}, together.worldFromBody};
    size_t left = 0;
    for (size_t part = 0; part < together.keys.size(); ++part) {
      const auto found = instance_of_key_.find(together.keys[part]);
      const bool stands = found != instance_of_key_.end() && stands_in(together, part, found->second);
      placement.instances.push_back(stands ? found->second : Placement::gone);
      if (stands) {
        placed[found->second] = true;
      } else {
        ++left;
        if (found != instance_of_key_.end()) movers_.insert(together.keys[part]);
        gone += size_t(std::ranges::count(body.part, uint32_t(part)));
      }
    }
    clusters += body.clusters.size();
    if (left < together.keys.size()) placements_.push_back(std::move(placement));
  }
  if (2 * gone > clusters) return false;
  for (uint32_t i = 0; i < placed.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    if (placed[i] || scene_->meshes[size_t(instance.mesh)].triangles.empty()) continue;
    placements_.push_back({body_of(instance.mesh), {i}, instance.worldFromObject});
  }
  // Nothing is left of a mesh of which no triangle is finite.
  std::erase_if(placements_, [&](const Placement& placement) { return bodies_[placement.body].clusters.empty(); });
  return true;
}

void Bodies::follow_deformed(const std::set<int>& deformed) {
  if (deformed.empty()) return;
  for (Body& body : bodies_) {
    size_t count = 0;  // of clusters that deform
    for (size_t part = 0; part < body.meshes.size(); ++part) {
      if (deformed.contains(body.meshes[part])) count += size_t(std::ranges::count(body.part, uint32_t(part)));
    }
    if (count == 0) continue;
    if (4 * count >= body.clusters.size()) {
      body.refit(*scene_);
      continue;
    }
    for (const int mesh : body.meshes) {
      if (deformed.contains(mesh)) lively_.insert(mesh);
    }
  }
}

void Bodies::update(const SceneChanges& changes) {
  if (changes.listed) {
    instance_of_key_.clear();
    for (uint32_t i = 0; i < scene_->instances.size(); ++i) instance_of_key_.emplace(scene_->instances[i].key, i);
  }
  bool fell_apart = false;
  for (Body& body : bodies_) {
    const auto is_in = [&](const std::set<int>& meshes) {
      return std::ranges::any_of(body.meshes, [&](int mesh) { return meshes.contains(mesh); });
    };
    if (is_in(changes.replaced)) {
      if (body.meshes.size() == 1) {
        body = Body(*scene_, body.meshes);
      } else {
        fell_apart = true;
      }
    }
  }
  if (fell_apart) {
    for (const Instance& instance : scene_->instances) {
      if (changes.replaced.contains(instance.mesh)) movers_.insert(instance.key);
    }
    return group();
  }
  follow_deformed(changes.deformed);
  if (!place()) group();
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
