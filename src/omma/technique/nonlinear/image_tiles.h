// A tree of cones over an image: squares of pixels, each with a cone around all rays of its pixels and samples. It says
// where a triangle may be seen through any camera, without projecting anything.
#pragma once

#include <optional>
#include <vector>

#include "omma/technique/replication/cone_tree.h"
#include "omma/technique/view.h"

namespace omma {

/// A square of pixels of a view's tile, and a cone around its rays.
struct ImageSquare {
  int x = 0, y = 0, side = 0;
  glm::dvec3 axis{0.0, 0.0, -1.0};
  double angle = 0.0;   ///< radians; up to pi
  int descendants = 0;  ///< squares that follow and lie within this one
};

/// The squares in which the camera sees anything, of 4 pixels and 4, 16, … times as many along a side, each before
/// those that lie in it.
std::vector<ImageSquare> image_squares(const Camera& camera, const PixelRect& tile, bool shifted);

class ImageTiles : public ConeTree {
 public:
  void set(const View& view);

  void bind() const override;
  void set_uniforms(const gl::Program& program) const override;
  gl::Defines coverage_defines() const override { return {{"COVERAGE", "technique/nonlinear/coverage.glsl"}}; }
  size_t bytes() const { return nodes_.bytes(); }

 private:
  std::optional<Camera> camera_;  ///< kept alive: another one may not come to lie at its address
  PixelRect tile_;
  bool shifted_ = false;  ///< passes may sample up to half a pixel beside
  int node_count_ = 0;
  gl::Texels nodes_{GL_RGBA32UI};
};

}  // namespace omma
