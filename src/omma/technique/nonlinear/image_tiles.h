// A tree of cones over an image: squares of pixels, each with a cone around all rays of its pixels and samples. It says
// where a triangle may be seen through any camera, without projecting anything. For a lens it also knows how straight
// the edges of triangles are in the image.
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

/// The squares in which the camera sees anything, of 1, 4, 16, … pixels a side, each before
/// those that lie in it.
std::vector<ImageSquare> image_squares(const Camera& camera, const PixelRect& tile, bool shifted);

/// How triangles are drawn: all exactly, or those that the lens leaves straight apart.
enum class Forms { all_exact, straight, all_but_straight };

class ImageTiles : public ConeTree {
 public:
  /// The view must outlive what is drawn with it.
  void set(const View& view);

  void bind() const override;
  void set_uniforms(const gl::Program& program) const override;
  gl::Defines coverage_defines() const override;
  /// PROJECTS and the camera's symbols, where triangles are given outlines of their own.
  gl::Defines outline_defines() const;
  /// Which triangles are looked for next; the others reach nothing.
  void look_for(Forms forms) { forms_ = forms; }
  size_t bytes() const { return nodes_.bytes() + curvature_.bytes(); }

 private:
  const View* view_ = nullptr;
  Forms forms_ = Forms::all_exact;
  std::optional<Camera> camera_;  ///< kept alive: another one may not come to lie at its address
  PixelRect tile_;
  bool shifted_ = false;  ///< passes may sample up to half a pixel beside
  int node_count_ = 0;
  gl::Texels nodes_{GL_RGBA32UI}, curvature_{GL_RGB32F};
};

}  // namespace omma
