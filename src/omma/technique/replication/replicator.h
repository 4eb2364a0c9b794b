// Which triangles go into which parts of an image, found by compute shaders: count, prefix sums, write. The order of
// the triangles is kept, and of each triangle's parts, so that one frame is like the next.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "omma/technique/replication/cone_tree.h"
#include "omma/technique/replication/scene_clusters.h"
#include "omma/technique/technique.h"

namespace omma {

/// What is drawn for each replica. Vertices are numbered through: a triangle's three, or a fan's six.
enum class ReplicaShape { triangle, hexagon };

class Replicator {
 public:
  explicit Replicator(DrawTools& tools, ReplicaShape shape = ReplicaShape::triangle) : tools_(tools), shape_(shape) {}

  /// Of the first `cluster_count` clusters; a slot is cluster_triangles times a cluster's number, plus a triangle's.
  void replicate_clusters(const ConeTree& tree, SceneClusters& clusters, uint32_t cluster_count);
  /// Of a list of items (part << 10 | triangle); a slot is a place in the list.
  void replicate_items(const ConeTree& tree, const SceneClusters& clusters, std::span<const uint32_t> items);

  /// Prepares a draw for each range of slots, the last one excluded.
  void prepare_draws(std::span<const glm::uvec2> ranges);
  /// Texture unit 21.
  void bind() const;
  /// Draws the replicas of the range of that number with the program in use. Binds a vertex array.
  void draw(size_t range) const;

  uint32_t replica_count() const { return replica_count_; }
  size_t bytes() const {
    return counts_.bytes() + found_pieces_.bytes() + replicas_.bytes() + ranges_.bytes() + commands_.bytes() +
           indices_.bytes();
  }

 private:
  void replicate(const ConeTree& tree, const SceneClusters& clusters, uint32_t groups, gl::Defines defines,
                 const char* size_name, uint32_t size);
  void set_levels(const gl::Program& program) const;
  void sum();

  uint32_t indices_per_replica() const { return shape_ == ReplicaShape::triangle ? 3 : 12; }
  void reserve_indices();

  DrawTools& tools_;
  ReplicaShape shape_;
  gl::VertexArray vertices_ = gl::create_vertex_array();  ///< none; indices where the shape has some
  std::vector<uint32_t> level_first_, level_sizes_;
  gl::Texels replicas_{GL_RG32UI}, items_{GL_R32UI};
  gl::Buffer counts_, found_pieces_, ranges_, commands_, indices_;
  uint32_t replica_count_ = 0;
};

}  // namespace omma
