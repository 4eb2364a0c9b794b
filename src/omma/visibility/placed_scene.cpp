#include "omma/visibility/placed_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "omma/scene/coverage.h"

namespace omma {
namespace {

/// A power of two that brings lengths up to `reach` near 1.
double scale_for(double reach) {
  return std::exp2(-std::clamp(reach > 0.0 ? std::ceil(std::log2(reach)) : 0.0, -120.0, 120.0));
}

}  // namespace

PlacedScene::PlacedScene(const SceneIndex& index, const glm::dmat4& worldFromCamera, std::optional<int> hidden_object)
    : index_(&index), top_(index.top()) {
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  const size_t count = top_.leaves.size();
  std::vector<const Placement*> placements(count);
  std::vector<size_t> first_part(count + 1, 0);
  for (size_t leaf = 0; leaf < count; ++leaf) {
    placements[leaf] = &index.bodies().placements()[top_.order[top_.leaves[leaf].first]];
    first_part[leaf + 1] = first_part[leaf] + placements[leaf]->instances.size();
  }
  placed_.resize(count);
  parts_.resize(first_part.back());
  std::vector<Box> boxes(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t leaf) {
    boxes[leaf] = place(*placements[leaf], cameraFromWorld, hidden_object, placed_[leaf], &parts_[first_part[leaf]]);
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
  top_frame_.pad = float(2e-6 * reach) * top_frame_.scale;
  for (glm::vec3& column : top_frame_.columns) column *= top_frame_.scale;
}

Box PlacedScene::place(const Placement& placement, const glm::dmat4& cameraFromWorld, std::optional<int> hidden_object,
                       PlacedBody& placed, PlacedPart* parts) const {
  const Scene& scene = index_->scene();
  const Body& body = index_->bodies().bodies()[placement.body];
  const glm::dmat4 cameraFromObject = cameraFromWorld * placement.worldFromBody;
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
    PlacedPart& part = parts[i];
    part.mesh = &scene.meshes[size_t(body.meshes[i])];
    part.hidden = placement.instances[i] == Placement::gone;
    if (part.hidden) continue;
    const Instance& instance = scene.instances[placement.instances[i]];
    const Material& material = scene.materials[size_t(part.mesh->material)];
    if (!material.double_sided) part.front = mirrored ? 1.0f : -1.0f;
    part.alpha = material.alpha;
    part.cutoff = coverage_cutoff(material);
    part.first_triangle = instance.first_triangle;
    part.instance = placement.instances[i];
    part.hidden = instance.object == hidden_object;
    placed.blended = material.alpha == Material::Alpha::blend;
  }
  return to_box(to_bounds(body.bounds).transformed(cameraFromObject));
}

}  // namespace omma
