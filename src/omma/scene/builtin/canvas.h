// What pictures are painted on by code, and with: squares that wrap around, and noise that repeats without a seam.
#pragma once

#include <cstdint>
#include <vector>

#include "omma/scene/scene.h"

namespace omma::builtin {

/// sRGB values from 0 to 1 on a square that wraps around.
class Canvas {
 public:
  Canvas(int side, const glm::vec3& color)
      : side_(side), pixels_(static_cast<size_t>(side) * static_cast<size_t>(side), color) {}

  int side() const { return side_; }
  glm::vec3& at(int x, int y) {
    const auto wrap = [&](int i) { return static_cast<size_t>(((i % side_) + side_) % side_); };
    return pixels_[wrap(y) * static_cast<size_t>(side_) + wrap(x)];
  }
  /// In shares of the side, from the top left.
  void rectangle(float x0, float y0, float x1, float y1, const glm::vec3& color);
  /// Multiplies by 1 ± `amount`: noise with `cells` lumps along the side and finer ones on top.
  void mottle(int cells, float amount, uint64_t seed);
  /// Multiplies each texel by 1 ± `amount`.
  void grain(float amount, uint64_t seed);
  Texture texture(const char* name) const;

 private:
  void add_noise(int period, uint64_t seed, float weight, std::vector<float>& sum) const;

  int side_;
  std::vector<glm::vec3> pixels_;
};

/// Between -1 and 1, the same for a cell each time; cells repeat after `period`.
float lattice(int x, int y, int period, uint64_t seed);

/// Smooth noise between -1 and 1 that repeats after `period` cells. `x` and `y` in cells.
float periodic_noise(float x, float y, int period, uint64_t seed);

/// Lies on `height`, taken from the picture's brightness, as a normal map; `depth` in texels.
Texture normal_map(const Texture& picture, float depth);

}  // namespace omma::builtin
