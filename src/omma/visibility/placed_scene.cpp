#include "omma/visibility/placed_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

Bounds to_bounds(const Box& box) { return {glm::dvec3(box.min), glm::dvec3(box.max)}; }

/// Rounded outwards, within what single precision holds.
Box to_box(const Bounds& bounds) {
  constexpr double most = 1e38;
  const glm::dvec3 room = 1e-6 * glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return {glm::vec3(glm::clamp(bounds.min - room, -most, most)), glm::vec3(glm::clamp(bounds.max + room, -most, most))};
}

/// A power of two that brings lengths up to `reach` near 1.
double scale_for(double reach) {
  return std::exp2(-std::clamp(reach > 0.0 ? std::ceil(std::log2(reach)) : 0.0, -120.0, 120.0));
}

}  // namespace

PlacedScene::PlacedScene(const Scene& scene) : scene_(&scene) {
  meshes_.reserve(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes) {
    meshes_.emplace_back(mesh);
    has_blending_ |= scene.materials[size_t(mesh.material)].alpha == Material::Alpha::blend;
  }
  build_top();
  set_view(glm::dmat4(1.0));
}

void PlacedScene::update() {
  for (size_t m = 0; m < meshes_.size(); ++m) {
    if (scene_->meshes[m].deforms()) meshes_[m].refit(scene_->meshes[m]);
  }
  build_top();
}

void PlacedScene::build_top() {
  std::vector<uint32_t> shown;
  std::vector<Bounds> bounds;
  Bounds whole;
  for (size_t i = 0; i < scene_->instances.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    const MeshTree& mesh = meshes_[size_t(instance.mesh)];
    if (mesh.clusters().empty()) continue;
    shown.push_back(uint32_t(i));
    bounds.push_back(to_bounds(mesh.bounds()).transformed(instance.worldFromObject));
    whole.add(bounds.back());
  }
  // Far from the world's origin single precision would see all of them at one place.
  std::vector<Box> boxes;
  for (const Bounds& b : bounds) boxes.push_back(to_box({b.min - whole.center(), b.max - whole.center()}));
  top_ = build_box_tree(boxes, 1);
  numbers_.clear();
  for (const BoxTree::Leaf& leaf : top_.leaves) numbers_.push_back(shown[top_.order[leaf.first]]);
}

void PlacedScene::set_view(const glm::dmat4& worldFromCamera) {
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  instances_.assign(numbers_.size(), {});
  std::vector<Box> boxes(numbers_.size());
  tbb::parallel_for(size_t{0}, numbers_.size(), [&](size_t leaf) {
    const Instance& instance = scene_->instances[numbers_[leaf]];
    const Mesh& mesh = scene_->meshes[size_t(instance.mesh)];
    const Material& material = scene_->materials[size_t(mesh.material)];
    const MeshTree& tree = meshes_[size_t(instance.mesh)];
    const glm::dmat4 cameraFromObject = cameraFromWorld * instance.worldFromObject;
    const Bounds bounds = to_bounds(tree.bounds()).transformed(cameraFromObject);
    boxes[leaf] = to_box(bounds);

    PlacedInstance& placed = instances_[leaf];
    // What is rounded are the terms of matrix times point, which may be larger than their sum.
    double reach = 0.0;
    const glm::dvec3 farthest =
        glm::max(glm::abs(glm::dvec3(tree.bounds().min)), glm::abs(glm::dvec3(tree.bounds().max)));
    for (int row = 0; row < 3; ++row) {
      double terms = std::abs(cameraFromObject[3][row]);
      for (int column = 0; column < 3; ++column) terms += std::abs(cameraFromObject[column][row]) * farthest[column];
      reach = std::max(reach, terms);
    }
    const double scale = scale_for(reach);
    for (int column = 0; column < 3; ++column) {
      placed.columns[column] = glm::vec3(scale * glm::dvec3(cameraFromObject[column]));
    }
    placed.origin = glm::vec3(scale * glm::dvec3(cameraFromObject[3]));
    placed.scale = float(scale);
    placed.pad = float(2e-6 * reach * scale);
    const bool mirrored = glm::determinant(glm::dmat3(cameraFromObject)) < 0.0;
    placed.front = material.double_sided ? 0.0f : mirrored ? 1.0f : -1.0f;
    placed.nodes = tree.tree().nodes.data();
    placed.clusters = tree.clusters().data();
    placed.mesh = &mesh;
    placed.alpha = material.alpha;
    placed.cutoff = material.alpha_cutoff;
    placed.first_triangle = instance.first_triangle;
    placed.number = numbers_[leaf];
  });
  top_.refit(boxes);
  double reach = 0.0;
  for (const Box& box : boxes) {
    const glm::vec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
    reach = std::max<double>(reach, std::max({farthest.x, farthest.y, farthest.z}));
  }
  top_frame_ = {};
  top_frame_.nodes = top_.nodes.data();
  top_frame_.scale = float(scale_for(reach));
  for (glm::vec3& column : top_frame_.columns) column *= top_frame_.scale;
}

uint32_t PlacedScene::depth() const {
  uint32_t deepest = 0;
  for (const MeshTree& mesh : meshes_) deepest = std::max(deepest, mesh.tree().depth);
  return top_.depth + deepest;
}

size_t PlacedScene::bytes() const {
  size_t sum = top_.nodes.size() * sizeof(BoxNode) + instances_.size() * sizeof(PlacedInstance);
  for (const MeshTree& mesh : meshes_) sum += mesh.bytes();
  return sum;
}

}  // namespace omma
