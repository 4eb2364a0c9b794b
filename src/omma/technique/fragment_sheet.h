// Where fragments beyond each pixel's first are shaded: side by side on a sheet of their own, those of a material
// together, so that no shader runs for pixels that have none. Afterwards every pixel adds up its own.
#pragma once

#include <map>
#include <vector>

#include "omma/technique/sample_fragments.h"
#include "omma/technique/technique.h"

namespace omma {

class FragmentSheet {
 public:
  explicit FragmentSheet(DrawTools& tools) : tools_(tools) {}

  /// `squares` knows the places of the fragments' triangles.
  void lay_out(const View& view, const std::vector<SampleFragments::Fragment>& fragments,
               const VisibleSquares& squares);
  /// Binds the sheet to draw on and what says which fragment lies where, as shaders/technique/sight.glsl reads it.
  void begin() const;
  /// Adds the fragments to their pixels in the bound target of the view's size.
  void add_to_target(const View& view);

  /// Of the sheet.
  ImageSize size() const { return {width, height_}; }
  /// By material, of the sheet; the background as in VisibleSquares.
  const std::map<int, std::vector<glm::uvec2>>& squares() const { return squares_; }
  size_t bytes() const;

 private:
  static constexpr int width = 4096;

  DrawTools& tools_;
  int height_ = 0;
  std::map<int, std::vector<glm::uvec2>> squares_;
  gl::Texture colors_;
  gl::Framebuffer framebuffer_;
  /// By position on the sheet.
  gl::Texels places_{GL_R32UI}, coverage_{GL_RG8UI}, pixels_{GL_RG16UI};
  /// Where each fragment lies, pixel by pixel; and each pixel's run of them, the first shifted by run_bits, or'ed with
  /// their number.
  gl::Texels positions_{GL_R32UI}, runs_{GL_R32UI};
};

}  // namespace omma
