// The replica lists of the feedback variant (Lorenz, Döllner 2009, section 2.1, after their dynamic mesh refinement of
// 2008): each frame's list is made from the last one's by transform feedback. A list grows by a limited factor from one
// round to the next; rounds are repeated within a frame until nothing is missing.
#pragma once

#include <array>
#include <vector>

#include "omma/technique/piecewise/gpu_pieces.h"
#include "omma/technique/replication/scene_clusters.h"
#include "omma/technique/technique.h"

namespace omma {

class FeedbackLists {
 public:
  static constexpr int max_runs = 3;  ///< of a slot's record
  static constexpr int growth = 64;   ///< entries that an entry may become in a round

  explicit FeedbackLists(DrawTools& tools);

  /// Passes 1 and 2.
  void update(const GpuPieces& pieces, const SceneClusters& clusters);
  /// The scene has other triangles, or in another order.
  void forget() { lists_.clear(); }

  /// Texture unit 22.
  void bind() const;
  /// Draws the entries of the clusters' group of that number as points.
  void draw(size_t group) const;

  int rounds() const { return rounds_; }        ///< that the last update took
  int overflows() const { return overflows_; }  ///< lists that were too short in it and were made again
  size_t bytes() const;

 private:
  struct List {
    std::array<gl::Buffer, 2> entries;
    std::array<uint32_t, 2> counts{};
  };
  void start(const SceneClusters& clusters);
  bool count_pieces(const GpuPieces& pieces, const SceneClusters& clusters);
  void replicate(List& list);

  DrawTools& tools_;
  std::array<gl::Texels, 2> slots_{gl::Texels(GL_RGBA32UI), gl::Texels(GL_RGBA32UI)};
  gl::Buffer limited_;
  gl::VertexArray entries_array_;
  std::vector<List> lists_;  ///< of each group of clusters
  int now_ = 0;
  int rounds_ = 0, overflows_ = 0;
};

}  // namespace omma
