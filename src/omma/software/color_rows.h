// Where the colours of a picture go, square by square.
#pragma once

#include <glm/glm.hpp>

#include "omma/image/pixel_buffer.h"
#include "omma/visibility/ray_block.h"

namespace omma {

class ColorRows {
 public:
  static constexpr int pixels = RayBlock::leaves * 16;

  ColorRows(const PixelBuffer& buffer, ImageSize size);

  /// False where they are encoded: a square is then put once.
  bool adds_up() const { return bool(linear_); }

  /// The pixels of a square at `corner`, numbered as the rays of a block, linear RGB. `is_first`: in the place of what
  /// is there, which they are added to otherwise. Several threads may put squares at once.
  void put(const glm::vec3 (&colors)[pixels], bool is_first, glm::ivec2 corner) const;

 private:
  ImageSize size_;
  PixelRows<float> linear_;
  PixelRows<uint8_t> encoded_;
};

}  // namespace omma
