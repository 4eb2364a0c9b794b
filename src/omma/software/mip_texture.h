// A scene's texture with all its smaller levels, as the processor samples it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "omma/scene/scene.h"

namespace omma {

/// Level l has max(1, width >> l) x max(1, height >> l) texels, down to one.
struct MipTexture {
  static constexpr int most_levels = 32;

  explicit MipTexture(const Texture& texture);

  int width, height, levels;
  bool srgb;
  Texture::Wrap wrap_u, wrap_v;
  std::array<int32_t, most_levels> first{};  ///< a level's first texel
  std::vector<uint32_t> texels;              ///< 8-bit RGBA, R lowest; rows from the top

  size_t bytes() const { return texels.size() * sizeof(uint32_t); }
};

}  // namespace omma
