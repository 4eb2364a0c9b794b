// What moves as one: the instances that stand still beside each other under one tree of boxes, so that it is sorted by
// place and not by mesh; and each mesh that stands at many places under a tree that these share.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
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
  size_t body;
  std::vector<uint32_t> instances;  ///< of the scene, one for each of the body's meshes; all with the same transform
};

class Bodies {
 public:
  /// Sorts every mesh. The scene must outlive this object.
  explicit Bodies(const Scene& scene);

  /// Follows deformed vertices. Instances that have left the others of their body get one of their own.
  void update();

  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Placement>& placements() const { return placements_; }
  uint32_t depth() const;  ///< of the deepest tree, in nodes
  size_t bytes() const;

 private:
  void group();

  const Scene* scene_;
  std::vector<glm::dmat4> grouped_at_;  ///< by instance: its transform when bodies were made
  std::vector<bool> moves_;             ///< by instance: it has left a body
  std::vector<Body> bodies_;
  std::vector<Placement> placements_;
};

}  // namespace omma
