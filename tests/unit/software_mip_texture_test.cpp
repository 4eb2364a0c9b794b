// The levels of a texture are the means of what they cover, to the bit, though they are made row by row.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "omma/image/srgb.h"
#include "omma/software/box_filter.h"
#include "omma/software/mip_texture.h"

namespace omma {
namespace {

Texture random_texture(int width, int height, bool srgb) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.srgb = srgb;
  std::minstd_rand random(static_cast<unsigned>(width + 1000 * height));
  for (int i = 0; i < width * height; ++i) {
    texture.texels.emplace_back(random() % 256, random() % 256, random() % 256, random() % 256);
  }
  return texture;
}

uint8_t byte_of(float value) { return uint8_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))); }

/// One whole level after the other.
std::vector<uint32_t> by_levels(const Texture& texture) {
  std::vector<uint32_t> texels;
  std::vector<glm::vec4> level;
  for (const glm::u8vec4& t : texture.texels) {
    texels.push_back(uint32_t(t.r) | uint32_t(t.g) << 8 | uint32_t(t.b) << 16 | uint32_t(t.a) << 24);
    const auto linear = [&](uint8_t v) {
      return texture.srgb ? linear_from_srgb(float(v) / 255.0f) : float(v) / 255.0f;
    };
    level.emplace_back(linear(t.r), linear(t.g), linear(t.b), float(t.a) / 255.0f);
  }
  for (glm::ivec2 size(texture.width, texture.height); size != glm::ivec2(1); size = next_size(size)) {
    level = next_level(level, size);
    for (const glm::vec4& v : level) {
      uint32_t bits = uint32_t(byte_of(v.a)) << 24;
      for (int c = 0; c < 3; ++c) bits |= uint32_t(byte_of(texture.srgb ? srgb_from_linear(v[c]) : v[c])) << (8 * c);
      texels.push_back(bits);
    }
  }
  return texels;
}

TEST(MipTexture, RowByRowIsLevelByLevel) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1),
                                {2, 1},
                                {1, 7},
                                {3, 3},
                                {16, 16},
                                {17, 5},
                                {64, 1},
                                {31, 33},
                                {100, 63},
                                {5, 127},
                                {255, 2}}) {
    for (const bool srgb : {false, true}) {
      const Texture texture = random_texture(size.x, size.y, srgb);
      const MipTexture made(texture);
      EXPECT_EQ(made.texels, by_levels(texture)) << size.x << " x " << size.y << (srgb ? ", sRGB" : "");
      EXPECT_EQ(made.levels, std::bit_width(unsigned(std::max(size.x, size.y))));
      EXPECT_EQ(made.first[1], made.levels > 1 ? size.x * size.y : 0);
      EXPECT_EQ(size_t(made.first[size_t(made.levels - 1)]) + 1, made.texels.size());
    }
  }
}

}  // namespace
}  // namespace omma
