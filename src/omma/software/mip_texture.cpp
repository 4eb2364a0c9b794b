#include "omma/software/mip_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "omma/base/error.h"
#include "omma/image/srgb.h"
#include "omma/image/srgb8.h"
#include "omma/software/box_filter.h"

namespace omma {
namespace {

uint32_t packed(const glm::u8vec4& texel) {
  return uint32_t(texel.r) | uint32_t(texel.g) << 8 | uint32_t(texel.b) << 16 | uint32_t(texel.a) << 24;
}

/// From linear rows of one level to the packed rows of all that are smaller, with three rows of each kept: a level is
/// made of the numbers of the one before, not of their bytes.
class SmallerLevels {
 public:
  /// Writes the rows of the levels after `level`, whose size is given, to `texture`.
  SmallerLevels(MipTexture& texture, int level, glm::ivec2 size)
      : texture_(texture),
        level_(level),
        size_(size),
        next_size_(next_size(size)),
        across_(covered_by_next_level(size.x, next_size_.x)),
        down_(covered_by_next_level(size.y, next_size_.y)),
        kept_(size_t(rows_kept) * size_t(size.x)),
        made_(size_t(next_size_.x)),
        bytes_(size_t(next_size_.x)) {
    if (level + 2 < texture.levels) smaller_ = std::make_unique<SmallerLevels>(texture, level + 1, next_size_);
  }

  /// Of the rows in their order.
  void add_row(std::span<const glm::vec4> row) {
    std::copy(row.begin(), row.end(), kept(rows_++));
    while (made_rows_ < next_size_.y && last_covered(down_[size_t(made_rows_)]) < rows_) make_row();
  }

 private:
  static constexpr int rows_kept = 3;

  glm::vec4* kept(int row) { return kept_.data() + size_t(row % rows_kept) * size_t(size_.x); }

  static int last_covered(const Covered& covered) {
    int last = rows_kept - 1;
    while (covered.weight[last] == 0.0f) --last;
    return covered.first + last;
  }

  void make_row() {
    const Covered& down = down_[size_t(made_rows_)];
    for (int x = 0; x < next_size_.x; ++x) {
      const Covered& across = across_[size_t(x)];
      glm::vec4 sum(0.0f);
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
          const float weight = across.weight[i] * down.weight[j];
          if (weight != 0.0f) sum += weight * kept(down.first + j)[across.first + i];
        }
      }
      made_[size_t(x)] = sum;
    }
    pack(texture_.texels.data() + size_t(texture_.first[size_t(level_ + 1)]) +
         size_t(made_rows_) * size_t(next_size_.x));
    ++made_rows_;
    if (smaller_) smaller_->add_row(made_);
  }

  void pack(uint32_t* to) {
    const auto part = [](float value) { return uint8_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))); };
    if (texture_.srgb) srgb8_from_linear(&made_.data()->x, &bytes_.data()->x, 4 * made_.size());
    for (size_t i = 0; i < made_.size(); ++i) {
      glm::u8vec4& byte = bytes_[i];
      if (!texture_.srgb) byte = {part(made_[i].r), part(made_[i].g), part(made_[i].b), 0};
      byte.a = part(made_[i].a);
      to[i] = packed(byte);
    }
  }

  MipTexture& texture_;
  int level_;
  glm::ivec2 size_, next_size_;
  std::vector<Covered> across_, down_;
  std::vector<glm::vec4> kept_;  ///< the last rows, by their number modulo rows_kept
  std::vector<glm::vec4> made_;  ///< the row of the next level that was made last
  std::vector<glm::u8vec4> bytes_;
  std::unique_ptr<SmallerLevels> smaller_;
  int rows_ = 0, made_rows_ = 0;
};

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
  size_t count = 0;
  glm::ivec2 size(width, height);
  for (int l = 0; l < levels; ++l, size = next_size(size)) {
    first[size_t(l)] = int32_t(count);
    count += size_t(size.x) * size_t(size.y);
  }
  texels.resize(count);
  std::optional<SmallerLevels> smaller;
  if (levels > 1) smaller.emplace(*this, 0, glm::ivec2(width, height));
  std::vector<glm::vec4> row(static_cast<size_t>(width));
  for (int y = 0; y < height; ++y) {
    const size_t begin = size_t(y) * size_t(width);
    for (size_t x = 0; x < row.size(); ++x) {
      const glm::u8vec4& texel = texture.texels[begin + x];
      texels[begin + x] = packed(texel);
      row[x] = glm::vec4(linear_of[texel.r], linear_of[texel.g], linear_of[texel.b], float(texel.a) / 255.0f);
    }
    if (smaller) smaller->add_row(row);
  }
}

}  // namespace omma
