// From visible triangles to a picture: shades, or writes the channels of, a buffer of triangle numbers. Knows nothing
// of who found them.
#pragma once

#include "omma/technique/technique.h"
#include "omma/technique/visible_squares.h"
#include "omma/visibility/ray_hit.h"

namespace omma {

class Resolver {
 public:
  explicit Resolver(DrawTools& tools);

  /// The whole picture into the bound target of the view's size, the background included.
  void draw(const View& view, const VisibleTriangles& visible);
  /// Lays surfaces over what is there by their coverage.
  void draw_over(const View& view, const VisibleTriangles& visible);
  /// The blended surfaces of each pixel, nearest first, over what is there.
  void draw_layers(const View& view, const std::vector<std::vector<RayHit>>& surfaces);

  size_t bytes() const { return pixels_.bytes() + triangles_.bytes() + records_.bytes(); }

 private:
  /// Hands the visible triangles to the GPU and computes what is constant over each of them.
  void set(const View& view, const VisibleTriangles& visible);
  void draw_background(const View& view);
  void draw_surfaces(const View& view);
  /// `squares` with a program of technique/material_tile.vert.
  void draw_squares(const gl::Program& program, const View& view, const std::vector<glm::uvec2>& squares);
  gl::Defines record_defines(const View& view) const;

  DrawTools& tools_;
  VisibleSquares squares_;
  bool has_colors_ = false, has_tangents_ = false;
  gl::Texels pixels_{GL_R32UI}, triangles_{GL_RG32UI}, records_{GL_RGBA32F};
  gl::VertexArray squares_array_ = gl::create_vertex_array();
};

}  // namespace omma
