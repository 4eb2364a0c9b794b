// From visible triangles to a picture: shades, or writes the channels of, a buffer of triangle numbers. Knows nothing
// of who found them.
#pragma once

#include "omma/technique/fragment_sheet.h"
#include "omma/technique/technique.h"
#include "omma/visibility/ray_hit.h"

namespace omma {

class Resolver {
 public:
  explicit Resolver(DrawTools& tools);

  /// How many samples of a pixel `draw` takes of so large a picture: what is kept of each is bounded.
  size_t samples_at_once(ImageSize size) const;

  /// A new picture.
  void begin() { fragments_.clear(); }
  /// What the next sample of the view sees, for each of its shifts in turn. `visible` holds nothing of meaning
  /// afterwards.
  void add(VisibleTriangles& visible) { fragments_.add(visible); }
  /// The whole picture of the samples added, the background included; `target` is of the view's size and stays bound.
  /// Several are shaded once for each triangle of a pixel, in proportion to how many see it.
  void draw(const View& view, const Target& target);
  /// Lays surfaces over what is there by their coverage.
  void draw_over(const View& view, const VisibleTriangles& visible);
  /// The blended surfaces of each pixel, nearest first, over what is there.
  void draw_layers(const View& view, const std::vector<std::vector<RayHit>>& surfaces);

  size_t bytes() const {
    return pixels_.bytes() + coverage_.bytes() + triangles_.bytes() + records_.bytes() + sheet_.bytes() +
           fragments_.bytes();
  }

 private:
  /// An image to draw to, or the sheet of further fragments.
  struct Canvas {
    ImageSize size;
    const std::map<int, std::vector<glm::uvec2>>& squares;  ///< by material
    gl::Defines defines{};                                  ///< of shaders/technique/sight.glsl
  };
  /// Hands the visible triangles to the GPU and computes what is constant over each of them.
  void set(const View& view, const VisibleTriangles& visible);
  void draw_one(const View& view);
  void draw_several(const View& view, const Target& target);
  void clear_to_black();
  void draw_background(const View& view, const Canvas& canvas);
  void draw_surfaces(const View& view, const Canvas& canvas);
  /// What was drawn on the sheet.
  void add_sheet(const View& view, const Canvas& canvas);
  /// `squares` with a program of technique/material_tile.vert.
  void draw_squares(const gl::Program& program, const View& view, const Canvas& canvas,
                    const std::vector<glm::uvec2>& squares);
  gl::Defines record_defines(const View& view) const;

  DrawTools& tools_;
  VisibleSquares squares_;
  bool has_colors_ = false, has_tangents_ = false;
  gl::Texels pixels_{GL_R32UI}, coverage_{GL_RGBA8I}, triangles_{GL_RG32UI}, records_{GL_RGBA32F};
  SampleFragments fragments_;
  FragmentSheet sheet_;
  gl::VertexArray squares_array_ = gl::create_vertex_array();
};

}  // namespace omma
