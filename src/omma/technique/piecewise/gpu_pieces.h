// The pieces that make up a tile, on the GPU: their matrices, what they own, and a tree of cones over them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/camera/pieces/piece_set.h"
#include "omma/gl/context.h"
#include "omma/gl/objects.h"
#include "omma/gl/program.h"
#include "omma/math/bounds.h"
#include "omma/technique/replication/cone_tree.h"
#include "omma/technique/view.h"

namespace omma {

class GpuPieces : public ConeTree {
 public:
  /// Takes those of a camera in the pieces form that reach into the view's tile, as the view's pass samples it.
  void set(const Camera& pieces, const View& view);

  /// Texture units 16 to 18, 10 and 11.
  void bind() const override;
  gl::Defines coverage_defines() const override;
  /// For shaders/technique/mesh.frag and the vertex stages of technique/piecewise/.
  gl::Defines defines() const;
  void set_uniforms(const gl::Program& program) const override;

  size_t count() const { return planes_.size(); }
  /// Of all pieces; one that is mirrored turns the windings of its triangles round.
  bool any_mirrored() const { return any_mirrored_; }
  bool all_mirrored() const { return all_mirrored_; }
  bool is_mirrored(size_t piece) const { return mirrored_[piece]; }

  /// False when a box lies wholly beyond a side of the piece. `cameraFromWorld` is rigid.
  bool may_show(size_t piece, const glm::dmat4& cameraFromWorld, const Bounds& world) const;

  size_t bytes() const {
    return records_.bytes() + polygons_.bytes() + nodes_.bytes() + bin_first_.bytes() + bin_pieces_.bytes();
  }

 private:
  void fill_bins(const std::vector<uint32_t>& order);

  std::optional<Camera> camera_;  ///< kept alive: another one may not come to lie at its address
  const PieceSet* set_ = nullptr;
  PixelRect tile_;
  glm::dvec2 shift_{0.0};
  std::span<const glm::ivec2> sample_places_;
  std::vector<std::array<glm::dvec3, 4>> planes_;  ///< as in the record
  std::vector<bool> mirrored_;
  bool any_mirrored_ = false, all_mirrored_ = false, overlapping_ = false;
  int node_count_ = 0;
  gl::Texels records_{GL_RGBA32F}, polygons_{GL_RGBA32I}, nodes_{GL_RGBA32UI};
  gl::Texels bin_first_{GL_R32UI}, bin_pieces_{GL_R32UI};
};

}  // namespace omma
