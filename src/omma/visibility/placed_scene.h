// The scene as a camera sees it: trees of its meshes, and its instances relative to the camera under a tree of their
// own. Transforms are multiplied in double precision and rounded once.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/box_tree.h"
#include "omma/visibility/mesh_tree.h"

namespace omma {

/// One instance, ready for the finder. Its lengths are metres times `scale`, a power of two that brings everything it
/// holds near 1, so that products of three lengths neither overflow nor vanish.
struct PlacedInstance {
  glm::vec3 columns[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< cameraFromObject, scaled
  glm::vec3 origin{0.0f};
  float scale = 1.0f;
  float pad = 0.0f;    ///< what rounding may move a point by
  float front = 0.0f;  ///< the sign that n · d has on the side that is seen; 0: both sides are
  const BoxNode* nodes = nullptr;
  const Cluster* clusters = nullptr;  ///< null in the frame of the tree over instances
  const Mesh* mesh = nullptr;
  Material::Alpha alpha = Material::Alpha::opaque;
  float cutoff = 0.0f;  ///< masked materials: the coverage that stops a ray
  uint32_t first_triangle = 0;
  uint32_t number = 0;  ///< in the scene
};

class PlacedScene {
 public:
  /// The scene must outlive this object.
  explicit PlacedScene(const Scene& scene);

  /// Follows the scene's moved instances and deformed vertices.
  void update();
  void set_view(const glm::dmat4& worldFromCamera);

  const Scene& scene() const { return *scene_; }
  /// Over the instances that have triangles, in the camera frame, metres.
  const BoxTree& top() const { return top_; }
  const PlacedInstance& top_frame() const { return top_frame_; }               ///< in which the finder meets `top`
  const std::vector<PlacedInstance>& instances() const { return instances_; }  ///< by the leaves of `top`
  uint32_t depth() const;  ///< of nodes, from the scene's root down to the deepest mesh's last
  bool has_blending() const { return has_blending_; }
  size_t bytes() const;

 private:
  void build_top();

  const Scene* scene_;
  std::vector<MeshTree> meshes_;
  std::vector<PlacedInstance> instances_;
  BoxTree top_;
  PlacedInstance top_frame_;
  std::vector<uint32_t> numbers_;  ///< of the instances, in the scene
  bool has_blending_ = false;
};

}  // namespace omma
