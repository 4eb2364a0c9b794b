// The ways of finding where in the image a triangle is drawn. What is seen there is decided by one fragment stage.
#pragma once

#include <memory>

#include "omma/technique/nonlinear/exact_stage.h"
#include "omma/technique/technique.h"

namespace omma {

class BoundDrawer {
 public:
  virtual ~BoundDrawer() = default;
  /// Surfaces into the bound framebuffer.
  virtual void draw(const View& view, const ExactStage& exact) = 0;
  virtual void scene_changed(const SceneChanges&) {}
  virtual size_t buffer_bytes() const { return 0; }
};

/// Squares of the image under a tree of cones.
std::unique_ptr<BoundDrawer> make_hybrid_drawer(DrawTools& tools);

/// The paper's shapes around each triangle's image: up to four triangles, or one quad. Where a lens has no radial
/// symmetry, and where there is none, squares as in hybrid.
std::unique_ptr<BoundDrawer> make_triangle_drawer(DrawTools& tools);
std::unique_ptr<BoundDrawer> make_quad_drawer(DrawTools& tools);

}  // namespace omma
