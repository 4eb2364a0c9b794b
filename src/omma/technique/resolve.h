// From visible triangles to a picture: shades, or writes the channels of, a buffer of triangle numbers. Knows nothing
// of who found them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "omma/technique/technique.h"

namespace omma {

/// Which triangle each pixel's ray meets first. Rows from the top.
struct VisibleTriangles {
  static constexpr uint32_t nothing = 0xffffffffu;
  ImageSize size;
  std::vector<glm::uvec2> hits;  ///< x: the triangle's id, y: its instance; both `nothing` where there is none
};

class Resolver {
 public:
  explicit Resolver(DrawTools& tools) : tools_(tools) {}

  /// Into the bound target of the view's size. `blended` lays the surfaces over what is there by their coverage.
  void draw(const View& view, const VisibleTriangles& visible, bool blended);

 private:
  DrawTools& tools_;
  gl::Texture texture_;
  ImageSize texture_size_;
};

}  // namespace omma
