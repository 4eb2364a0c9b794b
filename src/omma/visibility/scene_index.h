// What finding needs of a scene, whoever looks at it and from where: its triangles sorted into clusters, and its bodies
// under a tree. Made once, read by any number of views at a time (placed_scene.h).
#pragma once

#include <mutex>
#include <optional>

#include "omma/scene/scene.h"
#include "omma/visibility/bodies.h"

namespace omma {

class SceneIndex {
 public:
  /// Sorts every mesh into clusters, on all cores. The scene must outlive this object.
  explicit SceneIndex(const Scene& scene);

  /// Follows the scene, which has changed so. Only meshes with other triangles are sorted. What was placed before is
  /// placed no more: no finder made before may be used.
  void update(const SceneChanges& changes);

  const Scene& scene() const { return *scene_; }
  const Bodies& bodies() const { return bodies_; }
  /// Over the placements of bodies: its shape alone, each view has boxes of its own. Empty when nothing is there.
  const BoxTree& top() const { return top_; }
  uint32_t depth() const { return top_.depth + bodies_.depth(); }  ///< of nodes, from the root down to the last
  bool has_blending() const { return has_blending_; }
  size_t bytes() const { return top_.nodes.size() * sizeof(BoxNode) + bodies_.bytes(); }

 private:
  void build_top();

  const Scene* scene_;
  Bodies bodies_;
  BoxTree top_;
  bool has_blending_ = false;
};

/// The index of a scene, made when somebody first asks for it: what is drawn by OpenGL alone does without.
class LazySceneIndex {
 public:
  /// The scene must outlive this object.
  explicit LazySceneIndex(const Scene& scene) : scene_(&scene) {}

  const Scene& scene() const { return *scene_; }
  /// From any number of threads at once.
  const SceneIndex& get() const;
  /// As SceneIndex::update, where there is one; while nobody uses it.
  void update(const SceneChanges& changes);
  /// 0 while there is none.
  size_t bytes() const;

 private:
  const Scene* scene_;
  mutable std::mutex mutex_;
  mutable std::optional<SceneIndex> index_;
};

}  // namespace omma
