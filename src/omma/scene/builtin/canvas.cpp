#include "omma/scene/builtin/canvas.h"

#include <algorithm>
#include <cmath>

#include "omma/scene/builtin/random.h"

namespace omma::builtin {
namespace {

/// A place between two cells: the first of them, and how much of the second there is.
struct Between {
  explicit Between(float place) : first(static_cast<int>(std::floor(place))) {
    const float t = place - std::floor(place);
    part = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
  }
  int first;
  float part;
};

}  // namespace

float lattice(int x, int y, int period, uint64_t seed) {
  const auto wrap = [&](int i) { return static_cast<uint64_t>(((i % period) + period) % period); };
  return Random(seed * 0x9E3779B97F4A7C15ull + wrap(x) * 0xD1B54A32D192ED03ull + wrap(y) * 0x8CB92BA72F3D8DD7ull)
      .between(-1.0f, 1.0f);
}

float periodic_noise(float x, float y, int period, uint64_t seed) {
  const Between across(x), down(y);
  const auto corner = [&](int i, int j) { return lattice(across.first + i, down.first + j, period, seed); };
  return std::lerp(std::lerp(corner(0, 0), corner(1, 0), across.part),
                   std::lerp(corner(0, 1), corner(1, 1), across.part), down.part);
}

void Canvas::rectangle(float x0, float y0, float x1, float y1, const glm::vec3& color) {
  const auto texel = [&](float share) { return static_cast<int>(std::lround(share * static_cast<float>(side_))); };
  for (int y = texel(y0); y < texel(y1); ++y) {
    for (int x = texel(x0); x < texel(x1); ++x) at(x, y) = color;
  }
}

void Canvas::mottle(int cells, float amount, uint64_t seed) {
  std::vector<float> sum(pixels_.size(), 0.0f);
  float weight = 0.6f;
  for (int period = cells, octave = 0; octave < 4; ++octave, period *= 2, weight *= 0.5f) {
    add_noise(period, seed + static_cast<uint64_t>(octave), weight, sum);
  }
  for (size_t i = 0; i < pixels_.size(); ++i) pixels_[i] *= 1.0f + amount * sum[i];
}

/// periodic_noise for each texel, of which many share the corners of a cell.
void Canvas::add_noise(int period, uint64_t seed, float weight, std::vector<float>& sum) const {
  std::vector<float> corners;
  corners.reserve(static_cast<size_t>(period) * static_cast<size_t>(period));
  for (int y = 0; y < period; ++y) {
    for (int x = 0; x < period; ++x) corners.push_back(lattice(x, y, period, seed));
  }
  const float scale = static_cast<float>(period) / static_cast<float>(side_);
  std::vector<Between> places;
  for (int i = 0; i < side_; ++i) places.emplace_back(static_cast<float>(i) * scale);
  const auto row_of = [&](int y) {
    return corners.data() + static_cast<ptrdiff_t>(y % period) * static_cast<ptrdiff_t>(period);
  };
  auto to = sum.begin();
  for (const Between& y : places) {
    const float *above = row_of(y.first), *below = row_of(y.first + 1);
    for (const Between& x : places) {
      const int left = x.first % period, right = (x.first + 1) % period;
      *to++ += weight * std::lerp(std::lerp(above[left], above[right], x.part),
                                  std::lerp(below[left], below[right], x.part), y.part);
    }
  }
}

void Canvas::grain(float amount, uint64_t seed) {
  Random random(seed);
  for (glm::vec3& pixel : pixels_) pixel *= 1.0f + amount * random.between(-1.0f, 1.0f);
}

Texture Canvas::texture(const char* name) const {
  Texture result;
  result.name = name;
  result.width = result.height = side_;
  result.texels.reserve(pixels_.size());
  for (const glm::vec3& pixel : pixels_) {
    result.texels.emplace_back(glm::clamp(pixel, 0.0f, 1.0f) * 255.0f + 0.5f, 255);
  }
  return result;
}

Texture normal_map(const Texture& picture, float depth) {
  Texture result = picture;
  result.name += " normals";
  result.srgb = false;
  const auto height = [&](int x, int y) {
    const int w = picture.width, h = picture.height;
    const glm::u8vec4 texel =
        picture.texels[static_cast<size_t>((y + h) % h) * static_cast<size_t>(w) + static_cast<size_t>((x + w) % w)];
    return static_cast<float>(texel.r + texel.g + texel.b) / 765.0f * depth;
  };
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      // +Y of a normal map is the picture's up, rows go down.
      const glm::vec3 normal =
          glm::normalize(glm::vec3(height(x - 1, y) - height(x + 1, y), height(x, y + 1) - height(x, y - 1), 2.0f));
      result.texels[static_cast<size_t>(y) * static_cast<size_t>(picture.width) + static_cast<size_t>(x)] =
          glm::u8vec4((normal * 0.5f + 0.5f) * 255.0f + 0.5f, 255);
    }
  }
  return result;
}

}  // namespace omma::builtin
