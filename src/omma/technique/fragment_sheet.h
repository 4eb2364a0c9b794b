// Where fragments beyond each pixel's first are shaded: side by side on a sheet of their own, those of a material
// together, so that no shader runs for pixels that have none. Afterwards pixels add up their own.
#pragma once

#include <map>
#include <vector>

#include "omma/gl/objects.h"
#include "omma/technique/sample_fragments.h"

namespace omma {

class FragmentSheet {
 public:
  /// Those of a picture of this size. `squares` knows the places of the fragments' triangles.
  void lay_out(ImageSize picture, const std::vector<SampleFragments::Fragment>& fragments,
               const VisibleSquares& squares);
  /// Binds the sheet to draw on and what says which fragment lies where, as shaders/technique/sight.glsl reads it.
  void begin() const;
  /// Binds what shaders/technique/add_fragments.frag reads.
  void bind() const;

  /// Of the sheet.
  ImageSize size() const { return {width, height_}; }
  /// Squares of the picture in which there are fragments.
  const std::vector<glm::uvec2>& picture_squares() const { return picture_squares_; }
  /// By material, of the sheet; the background as in VisibleSquares.
  const std::map<int, std::vector<glm::uvec2>>& squares() const { return squares_; }
  size_t bytes() const;

 private:
  static constexpr int width = 4096;

  int height_ = 0;
  std::vector<glm::uvec2> picture_squares_;
  std::map<int, std::vector<glm::uvec2>> squares_;
  gl::Texture colors_;
  gl::Framebuffer framebuffer_;
  /// By position on the sheet.
  gl::Texels places_{GL_R32UI}, coverage_{GL_RGBA8I}, pixels_{GL_RG16UI};
  /// Where each fragment lies, pixel by pixel; and each pixel's run of them: the first, and in the lowest bits how
  /// many.
  gl::Texels positions_{GL_RG16UI}, runs_{GL_R32UI};
};

}  // namespace omma
