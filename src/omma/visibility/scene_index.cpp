#include "omma/visibility/scene_index.h"

#include <algorithm>
#include <vector>

#include "omma/base/isolated.h"
#include "omma/math/bounds.h"

namespace omma {

SceneIndex::SceneIndex(const Scene& scene) : scene_(&scene), bodies_(scene) { build_top(); }

void SceneIndex::update(const SceneChanges& changes) {
  if (!changes.of_shape() && !changes.materials) return;
  bodies_.update(changes);
  build_top();
}

void SceneIndex::build_top() {
  has_blending_ = std::ranges::any_of(scene_->instances, [&](const Instance& instance) {
    const Mesh& mesh = scene_->meshes[size_t(instance.mesh)];
    return scene_->materials[size_t(mesh.material)].alpha == Material::Alpha::blend;
  });
  std::vector<Bounds> bounds;
  Bounds whole;
  for (const Placement& placement : bodies_.placements()) {
    bounds.push_back(to_bounds(bodies_.bodies()[placement.body].bounds).transformed(placement.worldFromBody));
    whole.add(bounds.back());
  }
  // Far from the world's origin single precision would see all of them at one place.
  std::vector<Box> boxes;
  for (const Bounds& b : bounds) boxes.push_back(to_box({b.min - whole.center(), b.max - whole.center()}));
  top_ = build_box_tree(boxes, 1);
}

const SceneIndex& LazySceneIndex::get() const {
  isolated([&] {
    const std::lock_guard lock(mutex_);
    if (!index_) index_.emplace(*scene_);
  });
  return *index_;
}

void LazySceneIndex::update(const SceneChanges& changes) {
  const std::lock_guard lock(mutex_);
  if (index_) index_->update(changes);
}

size_t LazySceneIndex::bytes() const {
  const std::lock_guard lock(mutex_);
  return index_ ? index_->bytes() : 0;
}

}  // namespace omma
