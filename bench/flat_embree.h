// Embree as somebody who wants nothing but the nearest triangle, or a plain picture of it, would use it: one tree over
// all triangles of a scene, packets of sixteen rays in squares of four.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "omma/scene/scene.h"

namespace omma::bench {

class FlatEmbree {
 public:
  /// Builds the tree over the scene as `worldFromCamera` sees it; `shades`: with what lambert wants.
  FlatEmbree(const Scene& scene, const glm::dmat4& worldFromCamera, bool shades = false);
  ~FlatEmbree();
  FlatEmbree(const FlatEmbree&) = delete;
  FlatEmbree& operator=(const FlatEmbree&) = delete;

  /// Fills in the nearest triangle's id and its instance for every ray, `width` to a row.
  void nearest(std::span<const glm::vec3> directions, int width, std::span<glm::uvec2> triangles) const;

  /// Fills in linear RGB for every ray: the material's base colour under one sun and ambient light, by Lambert, with
  /// interpolated normals; grey where nothing is.
  void lambert(std::span<const glm::vec3> directions, int width, std::span<glm::vec3> colors) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omma::bench
