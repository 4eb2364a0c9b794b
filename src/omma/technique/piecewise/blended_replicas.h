// Blended triangles in pieces, from back to front. Their order changes with every move of the camera, so that no
// earlier frame's replicas are of use: every variant that replicates draws them like this.
#pragma once

#include "omma/technique/piecewise/piece_drawer.h"
#include "omma/technique/replication/replicator.h"

namespace omma {

class BlendedReplicas {
 public:
  explicit BlendedReplicas(DrawTools& tools) : tools_(tools), replicator_(tools) {}

  void draw(const View& view, const GpuPieces& pieces, const SceneClusters& clusters);
  size_t bytes() const { return replicator_.bytes(); }

 private:
  DrawTools& tools_;
  Replicator replicator_;
};

}  // namespace omma
