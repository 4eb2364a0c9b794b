#include "omma/visibility/placed_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "omma/scene/coverage.h"

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

PlacedScene::PlacedScene(const Scene& scene) : scene_(&scene), bodies_(scene) {
  for (const Mesh& mesh : scene.meshes) {
    has_blending_ |= scene.materials[size_t(mesh.material)].alpha == Material::Alpha::blend;
  }
  build_top();
  set_view(glm::dmat4(1.0));
}

void PlacedScene::update() {
  bodies_.update();
  build_top();
}

void PlacedScene::build_top() {
  std::vector<Bounds> bounds;
  Bounds whole;
  for (const Placement& placement : bodies_.placements()) {
    const Instance& instance = scene_->instances[placement.instances.front()];
    bounds.push_back(to_bounds(bodies_.bodies()[placement.body].bounds).transformed(instance.worldFromObject));
    whole.add(bounds.back());
  }
  // Far from the world's origin single precision would see all of them at one place.
  std::vector<Box> boxes;
  for (const Bounds& b : bounds) boxes.push_back(to_box({b.min - whole.center(), b.max - whole.center()}));
  top_ = build_box_tree(boxes, 1);
}

void PlacedScene::set_view(const glm::dmat4& worldFromCamera, std::optional<int> hidden_object) {
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  const size_t count = top_.leaves.size();
  std::vector<const Placement*> placements(count);
  std::vector<size_t> first_part(count + 1, 0);
  for (size_t leaf = 0; leaf < count; ++leaf) {
    placements[leaf] = &bodies_.placements()[top_.order[top_.leaves[leaf].first]];
    first_part[leaf + 1] = first_part[leaf] + placements[leaf]->instances.size();
  }
  placed_.assign(count, {});
  parts_.assign(first_part.back(), {});
  std::vector<Box> boxes(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t leaf) {
    boxes[leaf] = place(*placements[leaf], cameraFromWorld, hidden_object, placed_[leaf], &parts_[first_part[leaf]]);
  });
  // The tree's leaves, unlike those of a body, change with every view.
  top_.refit(boxes);
  double reach = 0.0;
  for (const Box& box : boxes) {
    const glm::vec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
    reach = std::max<double>(reach, std::max({farthest.x, farthest.y, farthest.z}));
  }
  top_frame_ = {};
  top_frame_.nodes = top_.nodes.data();
  top_frame_.scale = float(scale_for(reach));
  top_frame_.pad = float(2e-6 * reach) * top_frame_.scale;
  for (glm::vec3& column : top_frame_.columns) column *= top_frame_.scale;
}

Box PlacedScene::place(const Placement& placement, const glm::dmat4& cameraFromWorld, std::optional<int> hidden_object,
                       PlacedBody& placed, PlacedPart* parts) const {
  const Body& body = bodies_.bodies()[placement.body];
  const glm::dmat4 cameraFromObject = cameraFromWorld * scene_->instances[placement.instances.front()].worldFromObject;
  // What is rounded are the terms of matrix times point, which may be larger than their sum.
  double reach = 0.0;
  const glm::dvec3 farthest = glm::max(glm::abs(glm::dvec3(body.bounds.min)), glm::abs(glm::dvec3(body.bounds.max)));
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
  placed.body = &body;
  placed.nodes = body.tree.nodes.data();
  placed.clusters = body.clusters.data();
  placed.parts = parts;
  const bool mirrored = glm::determinant(glm::dmat3(cameraFromObject)) < 0.0;
  for (size_t i = 0; i < placement.instances.size(); ++i) {
    const Instance& instance = scene_->instances[placement.instances[i]];
    const Mesh& mesh = scene_->meshes[size_t(instance.mesh)];
    const Material& material = scene_->materials[size_t(mesh.material)];
    parts[i] = {&mesh,
                material.double_sided ? 0.0f
                : mirrored            ? 1.0f
                                      : -1.0f,
                material.alpha,
                coverage_cutoff(material),
                instance.first_triangle,
                placement.instances[i],
                instance.object == hidden_object};
    placed.blended = material.alpha == Material::Alpha::blend;
  }
  return to_box(to_bounds(body.bounds).transformed(cameraFromObject));
}

size_t PlacedScene::bytes() const {
  return top_.nodes.size() * sizeof(BoxNode) + placed_.size() * sizeof(PlacedBody) +
         parts_.size() * sizeof(PlacedPart) + bodies_.bytes();
}

}  // namespace omma
