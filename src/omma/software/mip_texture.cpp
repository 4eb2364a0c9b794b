#include "omma/software/mip_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/image/srgb.h"
#include "omma/image/srgb8.h"
#include "omma/software/box_filter.h"

namespace omma {
namespace {

void pack(const std::vector<glm::vec4>& linear, bool srgb, std::vector<uint32_t>& to) {
  const auto part = [](float value) { return uint8_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))); };
  std::vector<glm::u8vec4> bytes(linear.size());
  if (srgb) srgb8_from_linear(&linear.data()->x, &bytes.data()->x, 4 * linear.size());
  for (size_t i = 0; i < linear.size(); ++i) {
    if (!srgb) bytes[i] = {part(linear[i].r), part(linear[i].g), part(linear[i].b), 0};
    bytes[i].a = part(linear[i].a);
    to.push_back(uint32_t(bytes[i].r) | uint32_t(bytes[i].g) << 8 | uint32_t(bytes[i].b) << 16 |
                 uint32_t(bytes[i].a) << 24);
  }
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
  std::vector<glm::vec4> level;
  level.reserve(texture.texels.size());
  for (const glm::u8vec4& texel : texture.texels) {
    texels.push_back(uint32_t(texel.r) | uint32_t(texel.g) << 8 | uint32_t(texel.b) << 16 | uint32_t(texel.a) << 24);
    level.emplace_back(linear_of[texel.r], linear_of[texel.g], linear_of[texel.b], float(texel.a) / 255.0f);
  }
  glm::ivec2 size(width, height);
  for (int l = 1; l < levels; ++l) {
    level = next_level(level, size);
    size = next_size(size);
    first[size_t(l)] = int32_t(texels.size());
    pack(level, srgb, texels);
  }
}

}  // namespace omma
