// The fragment stage that all variants share: bounding shapes go in, what rays see of their triangles comes out.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "omma/technique/mesh_pass.h"
#include "omma/technique/technique.h"

namespace omma {

/// What is made of the fragments.
enum class FragmentUse {
  surfaces,
  overdraw,  ///< colours that show which are kept
  touched,   ///< all, to be counted
  kept,      ///< those whose pixel's centre sees the triangle, to be counted
};

class ExactStage {
 public:
  explicit ExactStage(DrawTools& tools) : tools_(tools) {}

  /// What the next passes do with what they cover.
  void set(FragmentUse use) { use_ = use; }

  /// A pass with these stages before shaders/technique/nonlinear/exact.frag. They write EXACT_TRIANGLE, with
  /// nearest_depth() as depth, for shapes that cover every pixel and sample in which a triangle is seen, each once
  /// where they blend; a triangle that faces away (cull_sign) they leave out. They have the symbols and uniforms of the
  /// camera, NEAR and `tile_size`. The view must outlive the pass.
  MeshPass pass(const View& view, std::vector<gl::Stage> stages) const;
  /// A pass without that fragment stage, for triangles that are straight.
  MeshPass straight_pass(const View& view, std::vector<gl::Stage> stages) const;

 private:
  DrawTools& tools_;
  FragmentUse use_ = FragmentUse::surfaces;
};

}  // namespace omma
