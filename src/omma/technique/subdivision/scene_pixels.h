// Where every vertex of every instance lies in the image: found once a picture, so that whatever is made of a vertex
// begins at the same place.
#pragma once

#include <vector>

#include "omma/gl/objects.h"
#include "omma/technique/subdivision/lens_field.h"
#include "omma/technique/technique.h"

namespace omma {

class ScenePixels {
 public:
  explicit ScenePixels(DrawTools& tools);

  void project(const View& view, const LensField& field);
  /// Pixels at unit 18, what is added to a vertex's number for an instance's pixel at unit 19.
  void bind() const;
  /// Wraps round.
  uint32_t offset(int instance) const { return offsets_[size_t(instance)]; }
  size_t bytes() const { return pixels_.bytes() + commands_.bytes() + offset_texels_.bytes(); }

 private:
  DrawTools& tools_;
  std::vector<uint32_t> offsets_;  ///< of each instance
  gl::Texels pixels_{GL_RG32F}, offset_texels_{GL_R32UI};
  gl::Buffer commands_;
  GLsizei command_count_ = 0;
};

}  // namespace omma
