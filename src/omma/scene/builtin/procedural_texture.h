// Pictures painted by code: they repeat without a seam, and are the same on every machine.
#pragma once

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

/// Smooth noise between -1 and 1 that repeats after `period` cells. `x` and `y` in cells.
float periodic_noise(float x, float y, int period, uint64_t seed);

/// Lies on `height`, taken from the picture's brightness, as a normal map; `depth` in texels.
Texture normal_map(const Texture& picture, float depth);

Texture paint_asphalt();
Texture paint_road();  ///< across: u; centre line and edges painted; v repeats every 8 m of 14
Texture paint_crossing();
Texture paint_pavement();
Texture paint_grass();
Texture paint_brick_windows();    ///< 4 windows wide, 4 storeys high
Texture paint_plaster_windows();  ///< 4 windows wide, 4 storeys high
Texture paint_glass_front();      ///< 4 panes wide, 4 storeys high
Texture paint_shopfront();        ///< 4 shops wide, one storey high
Texture paint_concrete();
Texture paint_roof_tiles();
Texture paint_bark();
Texture paint_leaves();
Texture paint_metal(const glm::vec3& color);
Texture paint_bricks();
Texture paint_stone();  ///< ashlar blocks
Texture paint_marble();
Texture paint_wood();
Texture paint_checker();
Texture paint_plaster();
Texture paint_cloth();
Texture paint_ground();  ///< grey detail for terrain, whose colour is in the vertices

}  // namespace omma::builtin
