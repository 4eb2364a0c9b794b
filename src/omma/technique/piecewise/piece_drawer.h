// The four ways of bringing triangles into pieces. Each draws the same replicas with the same arithmetic.
#pragma once

#include <memory>

#include "omma/technique/mesh_pass.h"
#include "omma/technique/piecewise/gpu_pieces.h"
#include "omma/technique/technique.h"

namespace omma {

class PieceDrawer {
 public:
  virtual ~PieceDrawer() = default;
  /// Surfaces into the bound framebuffer.
  virtual void draw(const View& view, const GpuPieces& pieces) = 0;
  virtual void scene_changed(const SceneChanges&) {}
  virtual size_t buffer_bytes() const { return 0; }
};

/// A draw of all parts for each piece that may show them.
std::unique_ptr<PieceDrawer> make_naive_drawer(DrawTools& tools);
/// Three passes with ping-pong buffers (section 2.1).
std::unique_ptr<PieceDrawer> make_feedback_drawer(DrawTools& tools);
/// One pass, in which the tessellation unit makes the replicas (section 2.2).
std::unique_ptr<PieceDrawer> make_tessellator_drawer(DrawTools& tools);
/// Counts, prefix sums and indirect draws.
std::unique_ptr<PieceDrawer> make_compute_drawer(DrawTools& tools);

/// A pass whose triangles are fetched by number and come with their piece.
MeshPass replica_pass(const GpuPieces& pieces, std::vector<gl::Stage> stages);

/// User clipping to the four sides of a piece, for as long as it lives.
class PieceClipping {
 public:
  PieceClipping() { set(glEnable); }
  ~PieceClipping() { set(glDisable); }
  PieceClipping(const PieceClipping&) = delete;
  PieceClipping& operator=(const PieceClipping&) = delete;

 private:
  template <typename Switch>
  static void set(Switch turn) {
    for (GLenum side = 0; side < 4; ++side) turn(GL_CLIP_DISTANCE0 + side);
  }
};

}  // namespace omma
