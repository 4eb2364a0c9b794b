#include "omma/software/color_rows.h"

#include <algorithm>

#include "omma/image/srgb8.h"

namespace omma {

ColorRows::ColorRows(const PixelBuffer& buffer, ImageSize size) : size_(size) {
  const size_t bytes = pixel_bytes(buffer.format, channel_info(Channel::color));
  if (buffer.format == PixelFormat::float32) {
    linear_ = {buffer, size, bytes};
  } else {
    encoded_ = {buffer, size, bytes};
  }
}

void ColorRows::put(const glm::vec3 (&colors)[pixels], bool is_first, glm::ivec2 corner) const {
  constexpr int side = RayBlock::side;
  const int across = std::min(side, size_.width - corner.x), down = std::min(side, size_.height - corner.y);
  float rows[side][3 * side];
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      float* to = &rows[RayBlock::y_of(leaf, ray)][3 * RayBlock::x_of(leaf, ray)];
      for (int c = 0; c < 3; ++c) to[c] = colors[leaf * 16 + ray][c];
    }
  }
  for (int y = 0; y < down; ++y) {
    if (encoded_) {
      srgb8_row(rows[y], size_t(across), encoded_.components, encoded_.at(corner.x, corner.y + y));
      continue;
    }
    float* to = linear_.at(corner.x, corner.y + y);
    for (int i = 0; i < 3 * across; ++i) to[i] = is_first ? rows[y][i] : to[i] + rows[y][i];
  }
}

}  // namespace omma
