// Which triangle every ray of a camera meets first, found by compute shaders: groups of clusters go down the tree of
// rays, what is left of their triangles meets the rays of its leaves. As omma/visibility/finder.h does on the
// processor, with the same rule for ties.
#pragma once

#include <cstdint>
#include <vector>

#include "omma/technique/technique.h"
#include "omma/technique/visibility/gpu_bodies.h"
#include "omma/technique/visibility/gpu_rays.h"
#include "omma/technique/visible_squares.h"
#include "omma/visibility/placed_scene.h"
#include "omma/visibility/ray_hit.h"

namespace omma {

class GpuFinder {
 public:
  /// Lists of what is still to be looked at hold `most_entries`, or what the driver's buffers do.
  explicit GpuFinder(DrawTools& tools, uint32_t most_entries = 1 << 27);

  /// Follows the scene's moved instances and deformed vertices. Call set_view afterwards.
  void update();
  /// Makes everything relative to the camera.
  void set_view(const glm::dmat4& worldFromCamera);

  /// The nearest triangle of every ray.
  VisibleTriangles nearest(const GpuRays& rays, Solid solid);
  /// All blended surfaces before what `nearest` has found last, with the same rays, nearest first.
  std::vector<std::vector<RayHit>> blended(const GpuRays& rays);

  bool has_blending() const { return index_.has_blending(); }
  size_t bytes() const;

 private:
  enum class Look { nearest, ids, blended };
  /// Pairs of a group and a node of the topmost level.
  struct Pairs {
    uint32_t first, end;
  };
  /// Goes down from those pairs whose groups are in the batch; -1: all of them.
  void pass(const GpuRays& rays, Look look, Solid solid, int batch, const Pairs& pairs);
  void pass_over_all(const GpuRays& rays, Look look, Solid solid, int batch);
  void sort_groups(int batch_count);
  void find_farthest(const GpuRays& rays);
  /// Over the list of counter `from`; what the program appends is counted by `to`.
  void run_listed(const gl::Program& program, uint32_t from, uint32_t invocations, uint32_t to);
  gl::Defines defines() const;

  void reserve_lists(uint32_t capacity);
  /// Of the longest list since reset_needed.
  uint32_t needed() const;
  void reset_needed();
  /// After a list was too short: longer ones, or, where they cannot be, fewer pairs at once.
  void make_room(const GpuRays& rays, uint32_t needed);
  uint32_t pair_count(const GpuRays& rays) const { return bodies_.placed_group_count() * rays.levels().back().count; }
  /// A portion of all pairs.
  Pairs pairs_from(const GpuRays& rays, uint32_t first) const;

  DrawTools& tools_;
  const SceneIndex& index_;
  GpuBodies bodies_;
  uint32_t capacity_ = 0, most_capacity_;
  uint32_t portions_ = 1;  ///< of all pairs, one after another
  gl::Texels lists_[2] = {gl::Texels(GL_RG32UI), gl::Texels(GL_RG32UI)};
  gl::Texels counts_{GL_R32UI}, seen_, farthest_{GL_R32UI}, batches_{GL_R32UI};
  gl::Buffer ids_, steps_, dispatch_, layers_;
};

}  // namespace omma
