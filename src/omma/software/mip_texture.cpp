#include "omma/software/mip_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/image/srgb.h"

namespace omma {
namespace {

/// Texels of one axis that a texel of the next level covers, and how much of each: three where the size is odd.
struct Covered {
  int first;
  float weight[3];
};

std::vector<Covered> covered_by_next_level(int size, int next) {
  std::vector<Covered> all(size_t(next), Covered{});
  const double step = double(size) / double(next);
  for (int i = 0; i < next; ++i) {
    const double begin = i * step, end = begin + step;
    Covered& covered = all[size_t(i)];
    covered.first = std::min(int(begin), size - 1);
    for (int k = 0; k < 3; ++k) {
      const double low = std::max(begin, double(covered.first + k));
      const double high = std::min(end, double(covered.first + k + 1));
      covered.weight[k] = float(std::max(0.0, high - low) / step);
    }
  }
  return all;
}

using Linear = std::vector<glm::vec4>;

Linear smaller(const Linear& level, glm::ivec2 size, glm::ivec2 next) {
  const std::vector<Covered> across = covered_by_next_level(size.x, next.x);
  const std::vector<Covered> down = covered_by_next_level(size.y, next.y);
  Linear result(size_t(next.x) * size_t(next.y));
  for (int y = 0; y < next.y; ++y) {
    for (int x = 0; x < next.x; ++x) {
      glm::vec4 sum(0.0f);
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
          const float weight = across[size_t(x)].weight[i] * down[size_t(y)].weight[j];
          if (weight == 0.0f) continue;
          const int column = across[size_t(x)].first + i, row = down[size_t(y)].first + j;
          sum += weight * level[size_t(row) * size_t(size.x) + size_t(column)];
        }
      }
      result[size_t(y) * size_t(next.x) + size_t(x)] = sum;
    }
  }
  return result;
}

uint32_t packed(const glm::vec4& linear, bool srgb) {
  uint32_t bits = 0;
  for (int c = 0; c < 4; ++c) {
    const float value = srgb && c < 3 ? srgb_from_linear(linear[c]) : linear[c];
    bits |= uint32_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))) << (8 * c);
  }
  return bits;
}

}  // namespace

MipTexture::MipTexture(const Texture& texture)
    : width(texture.width),
      height(texture.height),
      levels(int(std::bit_width(unsigned(std::max(width, height))))),
      srgb(texture.srgb),
      wrap_u(texture.wrap_u),
      wrap_v(texture.wrap_v) {
  if (size_t(width) * size_t(height) > size_t(std::numeric_limits<int32_t>::max()) / 2) {
    throw MachineError("texture '{}' is {} x {} pixels, more than can be numbered", texture.name, width, height);
  }
  std::array<float, 256> linear_of;
  for (size_t i = 0; i < 256; ++i) linear_of[i] = srgb ? linear_from_srgb(float(i) / 255.0f) : float(i) / 255.0f;
  Linear level;
  level.reserve(texture.texels.size());
  for (const glm::u8vec4& texel : texture.texels) {
    texels.push_back(uint32_t(texel.r) | uint32_t(texel.g) << 8 | uint32_t(texel.b) << 16 | uint32_t(texel.a) << 24);
    level.emplace_back(linear_of[texel.r], linear_of[texel.g], linear_of[texel.b], float(texel.a) / 255.0f);
  }
  glm::ivec2 size(width, height);
  for (int l = 1; l < levels; ++l) {
    const glm::ivec2 next = glm::max(size / 2, 1);
    level = smaller(level, size, next);
    first[size_t(l)] = int32_t(texels.size());
    for (const glm::vec4& value : level) texels.push_back(packed(value, srgb));
    size = next;
  }
}

}  // namespace omma
