// A Doric temple, 6 by 11 columns, after the proportions of the Parthenon's fronts.
#include <cmath>

#include <fmt/core.h>

#include "omma/scene/builtin/builtin.h"
#include "omma/scene/builtin/mesh_builder.h"
#include "omma/scene/builtin/procedural_texture.h"

namespace omma::builtin {
namespace {

enum TempleMaterial { marble, stone, tiles, meadow };

constexpr int across = 6, along = 11;  // columns of the fronts and the flanks
constexpr float spacing = 4.2f;        // metres from axis to axis
constexpr float shaft = 9.0f;          // metres
constexpr float step_height = 0.5f;
constexpr int steps = 3;
constexpr float floor_height = step_height * steps;
constexpr float capital = 1.1f;  // metres, echinus and abacus
constexpr int flutes = 20;
constexpr float half_width = 0.5f * spacing * (across - 1), half_length = 0.5f * spacing * (along - 1);
const Frame center{};

/// Two triangles a facet from floor to capital: forty facets a shaft, each a metre's tenth wide and nine metres long.
Mesh make_column() {
  Mesh mesh;
  mesh.name = "column";
  mesh.material = marble;
  const int facets = 2 * flutes;
  for (int i = 0; i < facets; ++i) {
    const auto corner = [&](int k, float radius, float y) {
      // Every second edge lies in a flute.
      const float angle = 6.2831853f * static_cast<float>(k % facets) / static_cast<float>(facets);
      const float depth = k % 2 ? 0.90f : 1.0f;
      return glm::vec3(std::sin(angle) * radius * depth, y, std::cos(angle) * radius * depth);
    };
    const float u0 = static_cast<float>(i) / 10.0f, u1 = static_cast<float>(i + 1) / 10.0f;
    add_quad(mesh, corner(i, 0.95f, 0.0f), corner(i + 1, 0.95f, 0.0f), corner(i + 1, 0.74f, shaft),
             corner(i, 0.74f, shaft), {u0, 0.0f, u1, 4.0f});
  }
  const glm::vec2 echinus[] = {{0.74f, shaft}, {1.15f, shaft + 0.6f}};
  add_lathe(mesh, glm::vec3(0.0f), echinus, 12, 4.0f);
  add_box(mesh, center, {-1.2f, shaft + 0.6f, -1.2f}, {1.2f, shaft + capital, 1.2f}, 3.0f);
  return mesh;
}

/// The steps, the inner chamber with its door, and what the columns carry.
Mesh make_body() {
  Mesh mesh;
  mesh.name = "body";
  mesh.material = stone;
  for (int i = 0; i < steps; ++i) {
    const float out = 1.6f + 0.7f * static_cast<float>(steps - i), y = step_height * static_cast<float>(i);
    add_box(mesh, center, {-half_width - out, i == 0 ? -0.3f : y, -half_length - out},
            {half_width + out, y + step_height, half_length + out}, 4.0f, white, sides_no_bottom);
  }
  const float w = half_width - spacing, l = half_length - spacing, top = floor_height + shaft + capital, t = 0.9f;
  add_box(mesh, center, {-w, floor_height, -l}, {-w + t, top, l}, 4.0f);
  add_box(mesh, center, {w - t, floor_height, -l}, {w, top, l}, 4.0f);
  add_box(mesh, center, {-w + t, floor_height, l - t}, {w - t, top, l}, 4.0f);
  add_box(mesh, center, {-w + t, floor_height, -l}, {-2.2f, top, -l + t}, 4.0f);
  add_box(mesh, center, {2.2f, floor_height, -l}, {w - t, top, -l + t}, 4.0f);
  add_box(mesh, center, {-2.2f, floor_height + 7.0f, -l}, {2.2f, top, -l + t}, 4.0f);
  // Architrave, frieze of triglyphs, cornice.
  add_box(mesh, center, {-half_width - 1.05f, top, -half_length - 1.05f},
          {half_width + 1.05f, top + 1.3f, half_length + 1.05f}, 4.0f);
  add_box(mesh, center, {-half_width - 1.0f, top + 1.3f, -half_length - 1.0f},
          {half_width + 1.0f, top + 2.6f, half_length + 1.0f}, 4.0f, Tint(190, 150, 130, 255), sides_walls);
  add_box(mesh, center, {-half_width - 1.7f, top + 2.6f, -half_length - 1.7f},
          {half_width + 1.7f, top + 3.0f, half_length + 1.7f}, 4.0f);
  const auto triglyph = [&](const Frame& side, float x) {
    add_box(mesh, side, {x - 0.42f, top + 1.3f, -0.12f}, {x + 0.42f, top + 2.6f, 0.05f}, 2.0f, white,
            side_front | side_left | side_right);
  };
  const glm::vec3 x(1, 0, 0), z(0, 0, 1);
  const auto side = [&](const glm::vec3& origin, const glm::vec3& right, const glm::vec3& back, int count) {
    for (int i = 0; i < 2 * count - 1; ++i) triglyph({origin, right, back}, 0.5f * spacing * static_cast<float>(i));
  };
  side({-half_width, 0.0f, half_length + 1.0f}, x, -z, across);
  side({half_width, 0.0f, -half_length - 1.0f}, -x, z, across);
  side({half_width + 1.0f, 0.0f, half_length}, -z, -x, along);
  side({-half_width - 1.0f, 0.0f, -half_length}, z, x, along);
  return mesh;
}

/// Two slopes and two gables, closed by the cornice below.
Mesh make_roof() {
  Mesh mesh;
  mesh.name = "roof";
  mesh.material = tiles;
  const float w = half_width + 1.7f, l = half_length + 1.7f, y = floor_height + shaft + capital + 3.0f,
              ridge = y + 3.6f;
  const UvRect uv{0.0f, 0.0f, 2.0f * l / 4.0f, std::hypot(w, 3.6f) / 4.0f};
  add_quad(mesh, {w, y, l}, {w, y, -l}, {0, ridge, -l}, {0, ridge, l}, uv);
  add_quad(mesh, {-w, y, -l}, {-w, y, l}, {0, ridge, l}, {0, ridge, -l}, uv);
  add_quad(mesh, {-w, y, -l}, {w, y, -l}, {w, y, l}, {-w, y, l}, uv);
  return mesh;
}

Mesh make_pediments() {
  Mesh mesh;
  mesh.name = "pediments";
  mesh.material = stone;
  const float w = half_width + 1.7f, l = half_length + 1.7f, y = floor_height + shaft + capital + 3.0f,
              ridge = y + 3.6f;
  add_triangle(mesh, {-w, y, l}, {w, y, l}, {0, ridge, l}, 4.0f);
  add_triangle(mesh, {w, y, -l}, {-w, y, -l}, {0, ridge, -l}, 4.0f);
  return mesh;
}

}  // namespace

Scene make_temple(const std::vector<double>&) {
  SceneBuilder builder("temple");
  builder.add_material(paint_marble(), 0.6f);
  const Texture ashlar = paint_stone();
  builder.add_material(ashlar, 0.8f);
  builder.material(stone).normal_texture = builder.add_texture(normal_map(ashlar, 6.0f));
  builder.add_material(paint_roof_tiles(), 0.8f);
  builder.add_material(paint_grass(), 1.0f);

  const int column = builder.add_mesh(make_column());
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < across; ++i) {
      if (i > 0 && i < across - 1 && j > 0 && j < along - 1) continue;
      builder.place(
          fmt::format("column {},{}", i, j), {&column, 1},
          {spacing * static_cast<float>(i) - half_width, floor_height, spacing * static_cast<float>(j) - half_length});
    }
  }
  const int parts[] = {builder.add_mesh(make_body()), builder.add_mesh(make_roof()),
                       builder.add_mesh(make_pediments())};
  builder.place("temple", parts);
  Mesh ground;
  ground.name = "meadow";
  ground.material = meadow;
  add_floor(ground, {-400.0f, 0.0f, -400.0f}, {400.0f, 0.0f, 400.0f}, 8.0f);
  const int ground_mesh = builder.add_mesh(std::move(ground));
  builder.place("meadow", {&ground_mesh, 1});
  builder.add_sun({-0.65, -0.6, -0.45}, glm::vec3(3.1f, 2.9f, 2.5f));
  builder.set_ambient({0.32f, 0.36f, 0.42f});
  return builder.finish({17.0, 2.6, half_length + 13.0}, {1.0, 7.0, 0.0});
}

}  // namespace omma::builtin
