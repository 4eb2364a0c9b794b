// The squares of an image as the GPU sees them. For a lens they know as well how straight the edges of triangles are.
#pragma once

#include <optional>

#include "omma/technique/nonlinear/image_squares.h"
#include "omma/technique/replication/cone_tree.h"
#include "omma/technique/view.h"

namespace omma {

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
  size_t bytes() const { return nodes_.bytes() + linear_rays_.bytes() + curvature_.bytes(); }

 private:
  const View* view_ = nullptr;
  Forms forms_ = Forms::all_exact;
  std::optional<Camera> camera_;  ///< kept alive: another one may not come to lie at its address
  PixelRect tile_;
  bool shifted_ = false;  ///< passes may sample up to half a pixel beside
  int node_count_ = 0;
  gl::Texels nodes_{GL_RGBA32UI}, linear_rays_{GL_RGBA32F}, curvature_{GL_RGB32F};
};

}  // namespace omma
