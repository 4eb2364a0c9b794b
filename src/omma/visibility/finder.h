// Which triangle every ray of a camera meets first, on the CPU: a tree of cones over the camera's own rays against a
// tree of boxes over clusters of triangles. Exact for every camera, formula or not, and needs no graphics driver.
//
// Coverage is the sign of three products of a ray with the planes through the camera's centre and a triangle's edges
// (docs/conventions.md), so nothing is clipped and neighbours leave no gap. The nearest triangle wins; at the same
// distance the one with the lower id.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/placed_scene.h"
#include "omma/visibility/ray_hit.h"
#include "omma/visibility/ray_tree.h"

namespace omma {

/// What the rays of a block meet.
struct FoundBlock {
  const RayBlock* block = nullptr;
  const SquareBorder* border = nullptr;  ///< of its square
  BlockPicture picture;
  std::vector<BlockLayer> layers;  ///< blended surfaces before what is in the picture, in no order
};

class Finder {
 public:
  /// What the rays of a camera at this pose meet. No ray meets `hidden_object`, but what is behind it. The index must
  /// outlive this object, and not be updated meanwhile; several finders may use it at once, on several threads.
  Finder(const SceneIndex& index, const glm::dmat4& worldFromCamera, std::optional<int> hidden_object = std::nullopt)
      : scene_(index, worldFromCamera, hidden_object) {}

  /// The nearest triangle of every ray, rows from the top: x its id over all instances, y its instance, both
  /// meets_nothing where there is none; y is no_ray where there is no ray. `distances` is empty or as long: metres,
  /// +inf where there is none. The result is the same, to the bit, on any number of threads.
  void nearest(const RayTree& rays, Solid solid, std::span<glm::uvec2> triangles,
               std::span<float> distances = {}) const;

  /// Calls `each`, on several threads at once, for every block in which there is a ray, with what its rays meet.
  void each_block(const RaySource& rays, Solid solid,
                  const std::function<void(const RayBlock&, const BlockPicture&)>& each) const;

  /// Calls `each`, on several threads at once, for every square of pixels in which there is a ray, with a block for
  /// each of its samples, blended surfaces apart from the others. Runs on all cores.
  void each_square(const RaySource& rays, const std::function<void(std::span<const FoundBlock>)>& each) const;

  /// All blended surfaces nearer than `distances` on each ray, nearest first.
  std::vector<std::vector<RayHit>> blended(const RayTree& rays, std::span<const float> distances) const;

 private:
  PlacedScene scene_;
};

}  // namespace omma
