// The scene's triangles as the GPU walks through them: parts, and clusters of 64 triangles, sorted by material.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "omma/gl/objects.h"
#include "omma/technique/gpu_scene.h"
#include "omma/technique/replication/cone_tree.h"
#include "omma/technique/technique.h"

namespace omma {

/// Clusters that are drawn with one program and one set of textures.
struct ClusterGroup {
  int material = 0;
  bool mirrored = false;
  bool blended = false;
  uint32_t first_cluster = 0, last_cluster = 0;  ///< the last one excluded
  friend bool operator==(const ClusterGroup&, const ClusterGroup&) = default;
};

/// Groups and, of each, the range of its slots in a list of replicas, the last one excluded.
struct DrawnGroups {
  std::vector<ClusterGroup> groups;
  std::vector<glm::uvec2> ranges;
  uint32_t clusters = 0;  ///< from the first on, that hold them all
};

class SceneClusters {
 public:
  static constexpr uint32_t cluster_triangles = 64;

  explicit SceneClusters(const GpuScene& scene);
  /// Takes over deformed vertices and mirrored transforms. False when the groups stay as they were.
  bool update(const SceneChanges& changes);

  /// The vertices and, at unit 19, the parts as buffer textures.
  void bind() const;
  /// Finds the part of the tree that each cluster can reach, and binds clusters and ranges to units 20
  /// and 25.
  void narrow(DrawTools& tools, const ConeTree& tree);

  /// Blended ones last.
  const std::vector<ClusterGroup>& groups() const { return groups_; }
  /// Those that need no order: all but blended ones, for labels these too.
  DrawnGroups unordered(bool labels) const;
  uint32_t cluster_count() const { return cluster_count_; }
  uint32_t solid_cluster_count() const { return solid_cluster_count_; }
  size_t bytes() const { return parts_.bytes() + clusters_.bytes() + ranges_.bytes(); }

 private:
  const GpuScene& scene_;
  std::vector<std::vector<glm::vec4>> spheres_;  ///< of each mesh's clusters, object frame
  std::vector<ClusterGroup> groups_;
  uint32_t cluster_count_ = 0, solid_cluster_count_ = 0;
  gl::Texels parts_{GL_RGBA32UI}, clusters_{GL_RGBA32UI}, ranges_{GL_RG32UI};
};

}  // namespace omma
