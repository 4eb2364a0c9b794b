// The scene for Embree: one tree per mesh, instances of them, ray by ray tests for facing and for holes.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/ray_hit.h"

namespace omma {

class EmbreeScene {
 public:
  /// Builds the trees. The scene must outlive this object.
  explicit EmbreeScene(const Scene& scene);
  ~EmbreeScene();
  EmbreeScene(EmbreeScene&&) noexcept;
  EmbreeScene& operator=(EmbreeScene&&) noexcept;

  /// Rebuilds what set_time deformed.
  void update(const SceneChanges& changes);
  /// Makes everything relative to the camera, so that rays start at zero and lose no precision far from the world's
  /// origin.
  void set_view(const glm::dmat4& worldFromCamera);

  /// The nearest hit of every ray of an image, in the camera frame; `distance` is +inf where there is none. Directions
  /// are `width` to a row, of unit length, or zero for no ray. `origins` is empty (all at the camera's centre) or as
  /// long as `directions`.
  void nearest(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, int width, Solid solid,
               std::span<RayHit> hits) const;

  /// All blended surfaces nearer than `limits` on each ray, nearest first.
  std::vector<std::vector<RayHit>> blended(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                                           std::span<const RayHit> limits) const;

  bool has_blending() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omma
