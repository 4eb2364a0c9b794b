// Embree as somebody who wants nothing but the nearest triangle would use it: one tree over all triangles of a scene,
// packets of sixteen rays in squares of four.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "omma/scene/scene.h"

namespace omma::bench {

class FlatEmbree {
 public:
  /// Builds the tree over the scene as `worldFromCamera` sees it.
  FlatEmbree(const Scene& scene, const glm::dmat4& worldFromCamera);
  ~FlatEmbree();
  FlatEmbree(const FlatEmbree&) = delete;
  FlatEmbree& operator=(const FlatEmbree&) = delete;

  /// Fills in the nearest triangle's id and its instance for every ray, `width` to a row.
  void nearest(std::span<const glm::vec3> directions, int width, std::span<glm::uvec2> triangles) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omma::bench
