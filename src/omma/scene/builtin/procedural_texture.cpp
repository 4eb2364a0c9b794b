#include "omma/scene/builtin/procedural_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "omma/scene/builtin/random.h"

namespace omma::builtin {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A running bond of `columns` by `rows` blocks with joints `joint` of a row high.
void lay_blocks(Canvas& canvas, int columns, int rows, float joint, const glm::vec3& joint_color, float variation,
                uint64_t seed) {
  const float row_height = static_cast<float>(canvas.side()) / static_cast<float>(rows);
  const float width = static_cast<float>(canvas.side()) / static_cast<float>(columns);
  for (int y = 0; y < canvas.side(); ++y) {
    const int row = static_cast<int>(static_cast<float>(y) / row_height);
    const float in_row = static_cast<float>(y) - static_cast<float>(row) * row_height;
    for (int x = 0; x < canvas.side(); ++x) {
      const float shifted = static_cast<float>(x) + (row % 2 ? 0.5f * width : 0.0f);
      const int column = static_cast<int>(shifted / width) % columns;
      const float in_column = std::fmod(shifted, width);
      if (in_row < joint * row_height || in_column < joint * row_height) {
        canvas.at(x, y) = joint_color;
      } else {
        canvas.at(x, y) *= 1.0f + variation * lattice(column, row, 4096, seed);
      }
    }
  }
}

/// 4 x 4 windows with frame, sill and panes; some are lit, some have curtains.
void set_windows(Canvas& canvas, const glm::vec3& frame, const glm::vec3& sill, uint64_t seed) {
  Random random(seed);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const float x = (static_cast<float>(column) + 0.5f) / 4.0f;
      const float y = (static_cast<float>(row) + 0.5f) / 4.0f;
      const float w = 0.062f, h = 0.078f, f = 0.010f;
      const float shade = random.between(0.7f, 1.15f);
      const glm::vec3 pane = random.below(7) == 0   ? glm::vec3(0.93f, 0.82f, 0.55f)
                             : random.below(4) == 0 ? glm::vec3(0.62f, 0.62f, 0.60f) * shade
                                                    : glm::vec3(0.22f, 0.29f, 0.37f) * shade;
      canvas.rectangle(x - w, y - h, x + w, y + h, frame);
      canvas.rectangle(x - w + f, y - h + f, x - 0.3f * f, y + h - f, pane);
      canvas.rectangle(x + 0.3f * f, y - h + f, x + w - f, y + h - f, pane * 0.94f);
      canvas.rectangle(x - w + f, y - 0.36f * h, x + w - f, y - 0.30f * h, frame);
      canvas.rectangle(x - w - f, y + h, x + w + f, y + h + 0.9f * f, sill);
      canvas.rectangle(x - w - f, y + h + 0.9f * f, x + w + f, y + h + 1.5f * f, sill * 0.55f);
      canvas.rectangle(x - w, y - h - 0.8f * f, x + w, y - h, sill * 0.7f);
    }
  }
}

}  // namespace

Texture paint_asphalt() {
  Canvas canvas(256, {0.31f, 0.31f, 0.32f});
  canvas.mottle(4, 0.12f, 1);
  canvas.grain(0.12f, 2);
  return canvas.texture("asphalt");
}

Texture paint_road() {
  Canvas canvas(512, {0.30f, 0.30f, 0.31f});
  canvas.mottle(6, 0.12f, 3);
  canvas.grain(0.10f, 4);
  const glm::vec3 paint(0.86f, 0.86f, 0.82f);
  canvas.rectangle(0.490f, 0.0f, 0.510f, 0.45f, paint);
  canvas.rectangle(0.040f, 0.0f, 0.052f, 1.0f, paint * 0.95f);
  canvas.rectangle(0.948f, 0.0f, 0.960f, 1.0f, paint * 0.95f);
  canvas.rectangle(0.0f, 0.0f, 0.022f, 1.0f, {0.42f, 0.41f, 0.39f});
  canvas.rectangle(0.978f, 0.0f, 1.0f, 1.0f, {0.42f, 0.41f, 0.39f});
  canvas.mottle(16, 0.06f, 5);
  return canvas.texture("road");
}

Texture paint_crossing() {
  Canvas canvas(256, {0.30f, 0.30f, 0.31f});
  for (int stripe = 0; stripe < 8; ++stripe) {
    const float x = (static_cast<float>(stripe) + 0.25f) / 8.0f;
    canvas.rectangle(x, 0.12f, x + 0.0625f, 0.88f, {0.86f, 0.86f, 0.83f});
  }
  canvas.mottle(8, 0.10f, 6);
  canvas.grain(0.08f, 7);
  return canvas.texture("crossing");
}

Texture paint_pavement() {
  Canvas canvas(256, {0.60f, 0.58f, 0.55f});
  canvas.mottle(4, 0.10f, 8);
  lay_blocks(canvas, 4, 8, 0.05f, {0.42f, 0.41f, 0.39f}, 0.06f, 9);
  canvas.grain(0.06f, 10);
  return canvas.texture("pavement");
}

Texture paint_grass() {
  Canvas canvas(256, {0.31f, 0.45f, 0.19f});
  canvas.mottle(4, 0.25f, 11);
  canvas.mottle(32, 0.25f, 12);
  canvas.grain(0.18f, 13);
  return canvas.texture("grass");
}

Texture paint_bricks() {
  Canvas canvas(256, {0.66f, 0.40f, 0.31f});
  canvas.mottle(4, 0.12f, 14);
  lay_blocks(canvas, 8, 24, 0.14f, {0.70f, 0.67f, 0.62f}, 0.16f, 15);
  canvas.grain(0.06f, 16);
  return canvas.texture("bricks");
}

Texture paint_brick_windows() {
  Canvas canvas(512, {0.68f, 0.43f, 0.34f});
  canvas.mottle(4, 0.12f, 17);
  lay_blocks(canvas, 32, 96, 0.2f, {0.70f, 0.66f, 0.60f}, 0.14f, 18);
  set_windows(canvas, {0.92f, 0.91f, 0.87f}, {0.80f, 0.78f, 0.72f}, 19);
  canvas.grain(0.03f, 20);
  return canvas.texture("brick");
}

Texture paint_plaster_windows() {
  Canvas canvas(512, {0.88f, 0.85f, 0.79f});
  canvas.mottle(4, 0.07f, 21);
  for (int row = 0; row < 4; ++row) {
    const float y = static_cast<float>(row) / 4.0f;
    canvas.rectangle(0.0f, y, 1.0f, y + 0.012f, {0.78f, 0.75f, 0.69f});
    canvas.rectangle(0.0f, y + 0.012f, 1.0f, y + 0.018f, {0.62f, 0.59f, 0.54f});
  }
  set_windows(canvas, {0.45f, 0.36f, 0.28f}, {0.72f, 0.70f, 0.66f}, 22);
  canvas.grain(0.03f, 23);
  return canvas.texture("plaster");
}

Texture paint_glass_front() {
  Canvas canvas(512, {0.36f, 0.47f, 0.55f});
  Random random(24);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const float x = static_cast<float>(column) / 4.0f, y = static_cast<float>(row) / 4.0f;
      const glm::vec3 pane = random.below(9) == 0 ? glm::vec3(0.80f, 0.76f, 0.60f)
                                                  : glm::vec3(0.34f, 0.46f, 0.55f) * random.between(0.75f, 1.15f);
      canvas.rectangle(x, y, x + 0.25f, y + 0.25f, {0.62f, 0.64f, 0.65f});
      canvas.rectangle(x + 0.010f, y + 0.055f, x + 0.118f, y + 0.24f, pane);
      canvas.rectangle(x + 0.128f, y + 0.055f, x + 0.240f, y + 0.24f, pane * 0.96f);
      canvas.rectangle(x, y + 0.005f, x + 0.25f, y + 0.045f, {0.26f, 0.31f, 0.35f});
    }
  }
  canvas.mottle(2, 0.10f, 25);
  return canvas.texture("glass");
}

Texture paint_shopfront() {
  Canvas canvas(512, {0.52f, 0.49f, 0.45f});
  const glm::vec3 awnings[] = {
      {0.62f, 0.20f, 0.18f}, {0.20f, 0.36f, 0.28f}, {0.22f, 0.30f, 0.48f}, {0.74f, 0.58f, 0.26f}};
  Random random(26);
  for (int shop = 0; shop < 4; ++shop) {
    const float x = static_cast<float>(shop) / 4.0f;
    const glm::vec3 goods(0.30f, 0.30f, 0.30f);
    canvas.rectangle(x + 0.012f, 0.10f, x + 0.238f, 0.30f, awnings[shop]);
    canvas.rectangle(x + 0.06f, 0.16f, x + 0.19f, 0.24f, {0.93f, 0.90f, 0.82f});
    canvas.rectangle(x + 0.02f, 0.34f, x + 0.165f, 0.86f, {0.28f, 0.33f, 0.36f});
    for (int i = 0; i < 6; ++i) {
      const float gx = x + 0.03f + 0.021f * static_cast<float>(i), gh = random.between(0.06f, 0.24f);
      canvas.rectangle(
          gx, 0.84f - gh, gx + 0.016f, 0.84f,
          goods * random.between(0.8f, 2.6f) * glm::vec3(1.0f, random.between(0.6f, 1.0f), random.between(0.5f, 0.9f)));
    }
    canvas.rectangle(x + 0.178f, 0.34f, x + 0.230f, 0.985f, {0.40f, 0.28f, 0.20f});
    canvas.rectangle(x + 0.186f, 0.38f, x + 0.222f, 0.70f, {0.28f, 0.34f, 0.38f});
  }
  canvas.mottle(8, 0.05f, 27);
  return canvas.texture("shopfront");
}

Texture paint_concrete() {
  Canvas canvas(256, {0.66f, 0.65f, 0.62f});
  canvas.mottle(3, 0.14f, 28);
  canvas.grain(0.05f, 29);
  return canvas.texture("concrete");
}

Texture paint_roof_tiles() {
  Canvas canvas(256, {0.60f, 0.32f, 0.24f});
  canvas.mottle(4, 0.14f, 30);
  lay_blocks(canvas, 12, 12, 0.10f, {0.33f, 0.17f, 0.13f}, 0.14f, 31);
  for (int y = 0; y < canvas.side(); ++y) {
    const float in_row = std::fmod(static_cast<float>(y) * 12.0f / 256.0f, 1.0f);
    for (int x = 0; x < canvas.side(); ++x) canvas.at(x, y) *= 0.78f + 0.34f * in_row;
  }
  return canvas.texture("roof tiles");
}

Texture paint_bark() {
  Canvas canvas(256, {0.40f, 0.31f, 0.23f});
  for (int y = 0; y < canvas.side(); ++y) {
    for (int x = 0; x < canvas.side(); ++x) {
      const float ridge = periodic_noise(static_cast<float>(x) / 8.0f, static_cast<float>(y) / 64.0f, 32, 32);
      canvas.at(x, y) *= 1.0f + 0.4f * ridge;
    }
  }
  canvas.mottle(16, 0.2f, 33);
  return canvas.texture("bark");
}

Texture paint_leaves() {
  Canvas canvas(256, {0.22f, 0.35f, 0.13f});
  Random random(34);
  for (int leaf = 0; leaf < 2600; ++leaf) {
    const int cx = random.below(256), cy = random.below(256), r = 2 + random.below(4);
    const glm::vec3 color = glm::vec3(0.28f, 0.44f, 0.15f) * random.between(0.55f, 1.45f);
    for (int y = -r; y <= r; ++y) {
      for (int x = -r; x <= r; ++x) {
        if (x * x + y * y <= r * r) canvas.at(cx + x, cy + y) = color * (1.0f - 0.05f * static_cast<float>(y));
      }
    }
  }
  return canvas.texture("leaves");
}

Texture paint_metal(const glm::vec3& color) {
  Canvas canvas(256, color);
  canvas.mottle(4, 0.10f, 35);
  canvas.grain(0.06f, 36);
  return canvas.texture("metal");
}

Texture paint_stone() {
  Canvas canvas(512, {0.80f, 0.75f, 0.66f});
  canvas.mottle(6, 0.16f, 37);
  lay_blocks(canvas, 4, 8, 0.03f, {0.50f, 0.46f, 0.39f}, 0.07f, 38);
  canvas.grain(0.04f, 39);
  return canvas.texture("stone");
}

Texture paint_marble() {
  Canvas canvas(512, {0.88f, 0.85f, 0.79f});
  for (int y = 0; y < canvas.side(); ++y) {
    for (int x = 0; x < canvas.side(); ++x) {
      const float fx = static_cast<float>(x) / 512.0f, fy = static_cast<float>(y) / 512.0f;
      const float warp =
          periodic_noise(fx * 6.0f, fy * 6.0f, 6, 40) + 0.5f * periodic_noise(fx * 12.0f, fy * 12.0f, 12, 41);
      const float vein = std::pow(1.0f - std::abs(std::sin(pi * (2.0f * fx + fy + 0.45f * warp))), 6.0f);
      canvas.at(x, y) *= 1.0f - 0.22f * vein;
    }
  }
  canvas.mottle(5, 0.08f, 42);
  return canvas.texture("marble");
}

Texture paint_wood() {
  Canvas canvas(512, {0.60f, 0.42f, 0.26f});
  for (int y = 0; y < canvas.side(); ++y) {
    const int plank = y / 64;
    for (int x = 0; x < canvas.side(); ++x) {
      const float fx = static_cast<float>(x) / 512.0f, fy = static_cast<float>(y) / 512.0f;
      const float shifted = fx + lattice(plank, 0, 8, 43);
      const float ring = periodic_noise(shifted * 4.0f + 64.0f, fy * 96.0f, 4 * 24, 44);
      canvas.at(x, y) *= 1.0f + 0.16f * ring + 0.12f * lattice(plank, 1, 8, 45);
      if (y % 64 < 2) canvas.at(x, y) *= 0.45f;
    }
  }
  canvas.grain(0.04f, 46);
  return canvas.texture("wood");
}

Texture paint_checker() {
  Canvas canvas(256, {0.86f, 0.84f, 0.80f});
  canvas.rectangle(0.0f, 0.0f, 0.5f, 0.5f, {0.24f, 0.25f, 0.28f});
  canvas.rectangle(0.5f, 0.5f, 1.0f, 1.0f, {0.24f, 0.25f, 0.28f});
  canvas.mottle(4, 0.12f, 47);
  return canvas.texture("checker");
}

Texture paint_plaster() {
  Canvas canvas(256, {0.86f, 0.82f, 0.74f});
  canvas.mottle(4, 0.08f, 48);
  canvas.mottle(32, 0.04f, 49);
  return canvas.texture("wall");
}

Texture paint_cloth() {
  Canvas canvas(256, {0.52f, 0.17f, 0.18f});
  for (int y = 0; y < canvas.side(); ++y) {
    for (int x = 0; x < canvas.side(); ++x) {
      const float weave = std::sin(static_cast<float>(x) * pi / 4.0f) * std::sin(static_cast<float>(y) * pi / 4.0f);
      canvas.at(x, y) *= 1.0f + 0.10f * weave;
    }
  }
  for (const float inset : {0.05f, 0.10f}) {
    const glm::vec3 gold(0.76f, 0.62f, 0.34f);
    canvas.rectangle(inset, inset, 1.0f - inset, inset + 0.015f, gold);
    canvas.rectangle(inset, 1.0f - inset - 0.015f, 1.0f - inset, 1.0f - inset, gold);
    canvas.rectangle(inset, inset, inset + 0.015f, 1.0f - inset, gold);
    canvas.rectangle(1.0f - inset - 0.015f, inset, 1.0f - inset, 1.0f - inset, gold);
  }
  canvas.grain(0.08f, 50);
  return canvas.texture("cloth");
}

Texture paint_ground() {
  Canvas canvas(512, {0.86f, 0.86f, 0.86f});
  canvas.mottle(4, 0.22f, 51);
  canvas.mottle(32, 0.22f, 52);
  canvas.grain(0.06f, 53);
  return canvas.texture("ground");
}

}  // namespace omma::builtin
