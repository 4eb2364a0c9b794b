// Mountains: ridged multifractal noise (Musgrave, in Ebert et al., Texturing and Modeling) on a square grid.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "omma/scene/builtin/builtin.h"
#include "omma/scene/builtin/mesh_builder.h"
#include "omma/scene/builtin/procedural_texture.h"

namespace omma::builtin {
namespace {

constexpr float extent = 4000.0f;  // metres along a side
constexpr float peak = 950.0f;     // metres, about
constexpr int tile = 64;           // quads along a mesh's side
constexpr float texture_metres = 60.0f;
/// The noise repeats after so many of its coarsest cells, far outside the picture.
constexpr int period = 64;
constexpr float coarse_cells = 3.0f;  // along the side

float height(float x, float z, uint64_t seed) {
  const float u = (x / extent + 0.5f) * coarse_cells + 7.0f, v = (z / extent + 0.5f) * coarse_cells + 7.0f;
  float sum = 0.0f, amplitude = 0.5f, weight = 1.0f;
  for (int octave = 0, scale = 1; octave < 9; ++octave, scale *= 2, amplitude *= 0.48f) {
    const float s = static_cast<float>(scale);
    const float n = periodic_noise(u * s, v * s, period * scale, seed * 31 + static_cast<uint64_t>(octave));
    const float ridge = (1.0f - std::abs(n)) * (1.0f - std::abs(n));
    sum += amplitude * ridge * weight;
    weight = std::clamp(ridge * 1.6f, 0.0f, 1.0f);
  }
  return peak * (sum - 0.25f);
}

/// Grass below, rock where it is steep, snow above; linear.
Tint ground_color(float y, float steepness, float variation) {
  const auto step = [](float low, float high, float t) {
    t = std::clamp((t - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
  };
  const glm::vec3 meadow(0.13f, 0.20f, 0.06f), rock(0.26f, 0.23f, 0.20f), snow(0.90f, 0.93f, 0.98f),
      scree(0.33f, 0.28f, 0.20f);
  glm::vec3 color = glm::mix(meadow, scree, step(0.30f * peak, 0.48f * peak, y + 60.0f * variation));
  color = glm::mix(color, rock, step(0.22f, 0.42f, steepness + 0.05f * variation));
  color = glm::mix(color, snow,
                   step(0.38f * peak, 0.48f * peak, y + 70.0f * variation) * (1.0f - step(0.45f, 0.66f, steepness)));
  return Tint(glm::clamp(color * (1.0f + 0.12f * variation), 0.0f, 1.0f) * 255.0f + 0.5f, 255);
}

}  // namespace

Scene make_terrain(const std::vector<double>& values) {
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(values[0] / 2.0))));
  const auto seed = static_cast<uint64_t>(values[1]);
  const float spacing = extent / static_cast<float>(side);
  const auto coordinate = [&](int i) { return static_cast<float>(i) * spacing - 0.5f * extent; };

  // One ring more than is drawn, so that normals at the border see both sides.
  const int stride = side + 3;
  std::vector<float> heights(static_cast<size_t>(stride) * static_cast<size_t>(stride));
  const auto at = [&](int i, int j) -> float& {
    return heights[static_cast<size_t>(j + 1) * static_cast<size_t>(stride) + static_cast<size_t>(i + 1)];
  };
  for (int j = -1; j <= side + 1; ++j) {
    for (int i = -1; i <= side + 1; ++i) at(i, j) = height(coordinate(i), coordinate(j), seed);
  }

  SceneBuilder builder("terrain");
  const int ground = builder.add_material(paint_ground(), 0.95f);
  for (int tj = 0; tj < side; tj += tile) {
    for (int ti = 0; ti < side; ti += tile) {
      const int columns = std::min(tile, side - ti), rows = std::min(tile, side - tj);
      Mesh mesh;
      mesh.name = fmt::format("tile {},{}", ti / tile, tj / tile);
      mesh.material = ground;
      for (int j = tj; j <= tj + rows; ++j) {
        for (int i = ti; i <= ti + columns; ++i) {
          const float x = coordinate(i), z = coordinate(j), y = at(i, j);
          const glm::vec3 normal =
              glm::normalize(glm::vec3(at(i - 1, j) - at(i + 1, j), 2.0f * spacing, at(i, j - 1) - at(i, j + 1)));
          mesh.positions.emplace_back(x, y, z);
          mesh.normals.push_back(normal);
          mesh.uvs.emplace_back(x / texture_metres, z / texture_metres);
          mesh.colors.push_back(ground_color(y, 1.0f - normal.y, periodic_noise(x / 45.0f, z / 45.0f, 4096, 99)));
        }
      }
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
          const auto v = static_cast<uint32_t>(j * (columns + 1) + i), below = v + static_cast<uint32_t>(columns) + 1;
          mesh.triangles.emplace_back(v, below, below + 1);
          mesh.triangles.emplace_back(v, below + 1, v + 1);
        }
      }
      const int index = builder.add_mesh(std::move(mesh));
      builder.place(fmt::format("tile {},{}", ti / tile, tj / tile), {&index, 1});
    }
  }
  builder.add_sun({-0.7, -0.5, -0.35}, glm::vec3(3.2f, 3.0f, 2.7f));
  builder.set_ambient({0.28f, 0.33f, 0.42f});
  // On a slope near the southern edge, 60 m above the ground, looking across.
  const float z = 0.36f * extent;
  return builder.finish({0.0, height(0.0f, z, seed) + 60.0, z}, {0.0, height(0.0f, 0.0f, seed), 0.0});
}

}  // namespace omma::builtin
