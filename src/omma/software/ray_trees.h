// The ray trees of the last cameras, which the next picture mostly shares.
#pragma once

#include <glm/glm.hpp>
#include <list>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/visibility/ray_tree.h"

namespace omma {

class RayTrees {
 public:
  /// A ray for each of `shifts` from the pixels' centres. Stays where it is while no other is asked for. Runs on all
  /// cores.
  const RayTree& of_tile(const Camera& camera, const PixelRect& tile, const std::vector<glm::dvec2>& shifts);

  /// The side of a tile that makes good use of the memory, with so many rays a pixel: whole blocks.
  static int good_tile(size_t samples);

  size_t bytes() const;

 private:
  struct Entry {
    Camera camera;
    PixelRect tile;
    std::vector<glm::dvec2> shifts;
    RayTree tree;
    size_t rays() const { return size_t(tree.size().width) * size_t(tree.size().height) * shifts.size(); }
  };
  std::list<Entry> entries_;  ///< the last used last
};

}  // namespace omma
