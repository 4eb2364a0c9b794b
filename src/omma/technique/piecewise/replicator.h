// Which triangles go into which pieces, found by compute shaders: count, prefix sums, write. The order of the triangles
// is kept, and of each triangle's pieces, so that one frame is like the next and like the other variants'.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "omma/technique/piecewise/gpu_pieces.h"
#include "omma/technique/piecewise/scene_clusters.h"
#include "omma/technique/technique.h"

namespace omma {

class Replicator {
 public:
  explicit Replicator(DrawTools& tools) : tools_(tools) {}

  /// Of the first `cluster_count` clusters; a slot is cluster_triangles times a cluster's number, plus a triangle's.
  void replicate_clusters(const GpuPieces& pieces, SceneClusters& clusters, uint32_t cluster_count);
  /// Of a list of items (part << 10 | triangle); a slot is a place in the list.
  void replicate_items(const GpuPieces& pieces, const SceneClusters& clusters, std::span<const uint32_t> items);

  /// Prepares a draw for each range of slots, the last one excluded.
  void prepare_draws(std::span<const glm::uvec2> ranges);
  /// Texture unit 21.
  void bind() const;
  /// Draws the replicas of the range of that number; a program with technique/piecewise/replica.vert is in use.
  void draw(size_t range) const;

  uint32_t replica_count() const { return replica_count_; }
  size_t bytes() const {
    return counts_.bytes() + found_pieces_.bytes() + replicas_.bytes() + ranges_.bytes() + commands_.bytes();
  }

 private:
  void replicate(const GpuPieces& pieces, const SceneClusters& clusters, uint32_t groups, gl::Defines defines,
                 const char* size_name, uint32_t size);
  void set_levels(const gl::Program& program) const;
  void sum();

  DrawTools& tools_;
  std::vector<uint32_t> level_first_, level_sizes_;
  gl::Texels replicas_{GL_RG32UI}, items_{GL_R32UI};
  gl::Buffer counts_, found_pieces_, ranges_, commands_;
  uint32_t replica_count_ = 0;
};

}  // namespace omma
