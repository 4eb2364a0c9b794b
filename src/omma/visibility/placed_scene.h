// The scene as one camera sees it: its bodies relative to the camera, under a tree of boxes of its own. Transforms are
// multiplied in double precision and rounded once. Any number of them may stand beside each other over one index.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/scene_index.h"

namespace omma {

/// One instance of a body's mesh.
struct PlacedPart {
  const Mesh* mesh = nullptr;
  float front = 0.0f;  ///< the sign that n · d has on the side that is seen; 0: both sides are
  Material::Alpha alpha = Material::Alpha::opaque;
  float cutoff = 0.0f;  ///< the least coverage that stops a ray, where the material is not opaque
  uint32_t first_triangle = 0;
  uint32_t instance = 0;  ///< in the scene
  bool hidden = false;    ///< nothing meets it
};

/// A body, ready for the finder. Its lengths are metres times `scale`, a power of two that brings everything it holds
/// near 1, so that products of three lengths neither overflow nor vanish.
struct PlacedBody {
  glm::vec3 columns[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< cameraFromObject, scaled
  glm::vec3 origin{0.0f};
  float scale = 1.0f;
  float pad = 0.0f;            ///< what rounding may move a point by
  const Body* body = nullptr;  ///< null in the frame of the tree over bodies
  const BoxNode* nodes = nullptr;
  const Cluster* clusters = nullptr;  ///< null in the frame of the tree over bodies
  const PlacedPart* parts = nullptr;
  bool blended = false;  ///< all its parts are, or none is
};

class PlacedScene {
 public:
  /// `hidden_object`, if any, is not there. The index must outlive this object, and not be updated meanwhile.
  PlacedScene(const SceneIndex& index, const glm::dmat4& worldFromCamera,
              std::optional<int> hidden_object = std::nullopt);
  PlacedScene(PlacedScene&&) = default;
  PlacedScene& operator=(PlacedScene&&) = default;

  const SceneIndex& index() const { return *index_; }
  const Scene& scene() const { return index_->scene(); }
  /// Over the bodies, in the camera frame, metres. Empty when nothing is there.
  const BoxTree& top() const { return top_; }
  const PlacedBody& top_frame() const { return top_frame_; }      ///< in which the finder meets `top`
  std::span<const PlacedBody> bodies() const { return placed_; }  ///< by the leaves of `top`

 private:
  /// Returns the body's box in the camera frame.
  Box place(const Placement& placement, const glm::dmat4& cameraFromWorld, std::optional<int> hidden_object,
            PlacedBody& placed, PlacedPart* parts) const;

  const SceneIndex* index_;
  std::vector<PlacedBody> placed_;
  std::vector<PlacedPart> parts_;
  BoxTree top_;
  PlacedBody top_frame_;
};

}  // namespace omma
