// What moves as one: the instances that stand still beside each other under one tree of boxes, so that it is sorted by
// place and not by mesh; and each mesh that stands at many places under a tree that these share.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/box_tree.h"
#include "omma/visibility/cluster.h"

namespace omma {

struct Body {
  std::vector<int> meshes;
  BoxTree tree;                   ///< its nodes' tags say which of the meshes a leaf is of
  std::vector<Cluster> clusters;  ///< by the tree's leaves
  std::vector<uint32_t> part;     ///< by the tree's leaves, the same as the tags
  Box bounds;

  /// Of the meshes. Runs on all cores.
  Body(const Scene& scene, std::vector<int> meshes);
  /// Takes over deformed vertices.
  void refit(const Scene& scene);
};

/// A body at a place.
struct Placement {
  static constexpr uint32_t gone = ~0u;
  size_t body;
  std::vector<uint32_t> instances;  ///< of the scene, one for each of the body's meshes; `gone` where it has left
  glm::dmat4 worldFromBody;
};

class Bodies {
 public:
  /// Sorts every mesh. The scene must outlive this object.
  explicit Bodies(const Scene& scene);

  /// Follows the scene, which has changed so. An instance that leaves the others of its body leaves a gap there and is
  /// a body of its own; so is one that comes. Meshes with other triangles are sorted anew, and all that stands together
  /// when one of them stood there, or when more than half of it has left.
  void update(const SceneChanges& changes);

  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Placement>& placements() const { return placements_; }
  uint32_t depth() const;  ///< of the deepest tree, in nodes
  size_t bytes() const;

 private:
  /// Instances of several meshes that stood still at one place when it was made.
  struct Together {
    size_t body;
    glm::dmat4 worldFromBody;
    bool blended;
    std::vector<uint32_t> keys;  ///< of the instances, one for each of the body's meshes
  };

  void group();
  /// False where so much has left that it is time to group anew.
  bool place();
  bool is_blended(int mesh) const;
  bool stands_in(const Together& together, size_t part, uint32_t instance) const;
  /// Takes over deformed vertices. Where they are few of many that stand together, those become bodies of their own.
  void follow_deformed(const std::set<int>& deformed);
  size_t body_of(int mesh);

  const Scene* scene_;
  std::vector<Body> bodies_;
  std::vector<Together> together_;
  std::vector<std::optional<size_t>> own_;  ///< by mesh: the body that holds nothing else
  std::unordered_map<uint32_t, uint32_t> instance_of_key_;
  std::unordered_set<int> lively_;       ///< meshes that have deformed among others that do not
  std::unordered_set<uint32_t> movers_;  ///< keys of instances that have moved away from others
  std::vector<Placement> placements_;
};

}  // namespace omma
