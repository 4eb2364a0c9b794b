#include "omma/image/shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace omma {
namespace {

FloatImage halved(const FloatImage& image) {
  FloatImage half({image.size.width / 2, image.size.height / 2}, image.components);
  for (int y = 0; y < half.size.height; ++y) {
    for (int x = 0; x < half.size.width; ++x) {
      for (int c = 0; c < image.components; ++c) {
        half.at(x, y)[c] = 0.25f * (image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                                    image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c]);
      }
    }
  }
  return half;
}

constexpr int taps = 8;

/// What lies `fraction` (0 to 1) behind the fourth of eight neighbours, by the polynomial through them all (Lagrange).
/// It moves smooth structure by just as much as it is asked to, and fine structure nearly so, which a cubic does not.
std::array<float, taps> weights_of(double fraction) {
  std::array<float, taps> weights{};
  const double place = fraction + taps / 2 - 1;
  for (int k = 0; k < taps; ++k) {
    double weight = 1.0;
    for (int j = 0; j < taps; ++j) {
      if (j != k) weight *= (place - j) / (k - j);
    }
    weights[size_t(k)] = float(weight);
  }
  return weights;
}

/// Along one axis; beyond the picture its border goes on.
void move_along(const FloatImage& from, FloatImage& to, double offset, bool along_x) {
  const double whole = std::floor(-offset);
  const std::array<float, taps> weights = weights_of(-offset - whole);
  const int first = int(whole) - taps / 2 + 1, last = (along_x ? from.size.width : from.size.height) - 1;
  for (int y = 0; y < from.size.height; ++y) {
    for (int x = 0; x < from.size.width; ++x) {
      float* out = to.at(x, y);
      std::fill_n(out, from.components, 0.0f);
      for (int k = 0; k < taps; ++k) {
        // What is not finite is left out by a weight of 0, too.
        const float weight = weights[size_t(k)];
        if (weight == 0.0f) continue;
        const int place = std::clamp((along_x ? x : y) + first + k, 0, last);
        const float* in = along_x ? from.at(place, y) : from.at(x, place);
        for (int c = 0; c < from.components; ++c) out[c] += weight * in[c];
      }
    }
  }
}

FloatImage moved(const FloatImage& image, const glm::dvec2& offset) {
  FloatImage across(image.size, image.components), result(image.size, image.components);
  move_along(image, across, offset.x, true);
  move_along(across, result, offset.y, false);
  return result;
}

/// One step of the fit: what is still missing from the offset by which `a` was moved. Nothing without structure.
std::optional<glm::dvec2> remaining_shift(const FloatImage& a, const FloatImage& b, int border) {
  glm::dmat2 structure(0.0);
  glm::dvec2 wanted(0.0);
  const auto middle = [&](int x, int y, int c) { return 0.5 * (double(a.at(x, y)[c]) + double(b.at(x, y)[c])); };
  for (int y = border; y < a.size.height - border; ++y) {
    for (int x = border; x < a.size.width - border; ++x) {
      for (int c = 0; c < a.components; ++c) {
        const glm::dvec2 slope(0.5 * (middle(x + 1, y, c) - middle(x - 1, y, c)),
                               0.5 * (middle(x, y + 1, c) - middle(x, y - 1, c)));
        const double rest = double(a.at(x, y)[c]) - double(b.at(x, y)[c]);
        if (!std::isfinite(slope.x) || !std::isfinite(slope.y) || !std::isfinite(rest)) continue;
        structure += glm::outerProduct(slope, slope);
        wanted += slope * rest;
      }
    }
  }
  const double determinant = glm::determinant(structure), trace = structure[0][0] + structure[1][1];
  if (!(determinant > 1e-9 * trace * trace)) return std::nullopt;
  return glm::inverse(structure) * wanted;
}

}  // namespace

std::optional<glm::dvec2> image_shift(const Image& a, const Image& b, Scale scale) {
  require_comparable(a, b);
  if (!std::holds_alternative<FloatImage>(a)) return std::nullopt;
  std::vector<std::array<FloatImage, 2>> levels;
  levels.push_back({scaled(std::get<FloatImage>(a), scale), scaled(std::get<FloatImage>(b), scale)});
  constexpr size_t most_levels = 4;
  constexpr int least_side = 32;
  while (levels.size() < most_levels) {
    const ImageSize size = levels.back()[0].size;
    if (std::min(size.width, size.height) < 2 * least_side) break;
    levels.push_back({halved(levels.back()[0]), halved(levels.back()[1])});
  }
  std::optional<glm::dvec2> shift;
  for (size_t level = levels.size(); level-- > 0;) {
    const auto& [first, second] = levels[level];
    glm::dvec2 offset = 2.0 * shift.value_or(glm::dvec2(0.0));
    shift.reset();
    const double most = 0.25 * std::min(first.size.width, first.size.height);
    constexpr int most_steps = 20;
    for (int step = 0; step < most_steps; ++step) {
      const int border = taps / 2 + int(std::ceil(std::max(std::abs(offset.x), std::abs(offset.y))));
      const auto rest = remaining_shift(moved(first, 0.5 * offset), moved(second, -0.5 * offset), border);
      if (!rest) break;
      offset = glm::clamp(offset + *rest, -most, most);
      shift = offset;
      if (glm::length(*rest) < 1e-4) break;
    }
  }
  return shift;
}

}  // namespace omma
