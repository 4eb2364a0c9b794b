// A narrow street between house fronts whose windows are painted, set back, or built with frames and sills.
#include "omma/scene/builtin/builtin.h"
#include "omma/scene/builtin/mesh_builder.h"
#include "omma/scene/builtin/procedural_texture.h"
#include "omma/scene/builtin/random.h"

namespace omma::builtin {
namespace {

enum FacadeMaterial { wall_brick, wall_plaster, windows, shops, trim, roofing, paving, street, panes, material_count };

constexpr int houses = 6;            // on each side
constexpr float house_width = 8.0f;  // metres
constexpr float house_depth = 9.0f;
constexpr float street_width = 9.0f;
constexpr float shop_height = 3.6f;
constexpr float storey = 3.1f;
constexpr int columns = 3;  // windows across a front

/// A hole in the front, two lengths of wall beside it, and the pane at its end.
void add_window(std::array<Mesh, material_count>& meshes, int wall, const Frame& frame, float width, float height,
                Tint tint, int detail) {
  const float w = 1.15f, sill = 0.85f, top = 2.55f, depth = 0.22f;
  const float x0 = 0.5f * (width - w), x1 = x0 + w;
  const auto panel = [&](float l, float b, float r, float t) {
    add_box(meshes[static_cast<size_t>(wall)], frame, {l, b, 0.0f}, {r, t, 0.0f}, 2.0f, tint, side_front);
  };
  panel(0.0f, 0.0f, width, sill);
  panel(0.0f, sill, x0, top);
  panel(x1, sill, width, top);
  panel(0.0f, top, width, height);
  // The hole's own sides look inward: a box seen from inside, its front and back left out.
  const auto p = [&](float x, float y, float z) { return frame.point(x, y, z); };
  Mesh& stone = meshes[trim];
  const UvRect uv{0.0f, 0.0f, 0.2f, 0.8f};
  add_quad(stone, p(x0, sill, 0), p(x0, sill, depth), p(x0, top, depth), p(x0, top, 0), uv, tint);
  add_quad(stone, p(x1, sill, depth), p(x1, sill, 0), p(x1, top, 0), p(x1, top, depth), uv, tint);
  add_quad(stone, p(x0, sill, 0), p(x1, sill, 0), p(x1, sill, depth), p(x0, sill, depth), uv, tint);
  add_quad(stone, p(x0, top, depth), p(x1, top, depth), p(x1, top, 0), p(x0, top, 0), uv, tint);
  add_box(meshes[panes], frame, {x0, sill, depth}, {x1, top, depth}, 4.0f, white, side_front);
  if (detail < 2) return;
  const unsigned open = sides_all & ~side_back;
  add_box(stone, frame, {x0 - 0.12f, sill - 0.12f, -0.16f}, {x1 + 0.12f, sill, 0.0f}, 2.0f, white, open);
  add_box(stone, frame, {0.5f * width - 0.035f, sill, depth - 0.08f}, {0.5f * width + 0.035f, top, depth}, 2.0f, white,
          side_front | side_left | side_right);
}

void add_house(std::array<Mesh, material_count>& meshes, Random& random, const Frame& frame, int detail) {
  const int storeys = 3 + random.below(2);
  const int wall = random.below(2) ? wall_brick : wall_plaster;
  const float light = random.between(0.75f, 1.0f);
  const Tint tint(glm::vec4(light, light * random.between(0.85f, 1.0f), light * random.between(0.7f, 1.0f), 1.0f) *
                  255.0f);
  const float eaves = shop_height + storey * static_cast<float>(storeys);
  const float first_shop = 0.25f * static_cast<float>(random.below(4));
  add_quad(meshes[shops], frame.point(0, 0, 0), frame.point(house_width, 0, 0),
           frame.point(house_width, shop_height, 0), frame.point(0, shop_height, 0),
           {first_shop, 0.0f, first_shop + 0.5f, 1.0f});
  if (detail == 0) {
    const float rows = static_cast<float>(storeys) / 4.0f;
    add_quad(meshes[windows], frame.point(0, shop_height, 0), frame.point(house_width, shop_height, 0),
             frame.point(house_width, eaves, 0), frame.point(0, eaves, 0), {0.0f, 0.0f, 0.75f, rows}, tint);
  } else {
    const float width = house_width / static_cast<float>(columns);
    for (int s = 0; s < storeys; ++s) {
      for (int c = 0; c < columns; ++c) {
        add_window(meshes, wall,
                   frame.at(width * static_cast<float>(c), shop_height + storey * static_cast<float>(s), 0.0f), width,
                   storey, tint, detail);
      }
    }
  }
  add_box(meshes[static_cast<size_t>(wall)], frame, {0.0f, 0.0f, 0.0f}, {house_width, eaves, house_depth}, 2.0f, tint,
          side_left | side_right | side_back);
  add_box(meshes[trim], frame, {0.0f, shop_height - 0.15f, -0.25f}, {house_width, shop_height + 0.12f, 0.0f}, 2.0f,
          white, sides_all & ~side_back);
  add_box(meshes[trim], frame, {-0.05f, eaves, -0.4f}, {house_width + 0.05f, eaves + 0.3f, house_depth}, 2.0f);
  const float ridge = eaves + random.between(2.4f, 3.4f), z0 = -0.3f, z1 = house_depth, m = 0.5f * house_depth;
  const auto p = [&](float x, float y, float z) { return frame.point(x, y, z); };
  const float y = eaves + 0.3f, w = house_width;
  add_quad(meshes[roofing], p(0, y, z0), p(w, y, z0), p(w, ridge, m), p(0, ridge, m), {0, 0, 2, 2});
  add_quad(meshes[roofing], p(w, y, z1), p(0, y, z1), p(0, ridge, m), p(w, ridge, m), {0, 0, 2, 2});
  const float chimney = random.between(0.8f, house_width - 1.6f);
  add_box(meshes[wall_brick], frame, {chimney, y + 0.4f, m + 0.3f}, {chimney + 0.8f, ridge + 0.8f, m + 1.1f}, 2.0f,
          white, sides_no_bottom);
  add_triangle(meshes[static_cast<size_t>(wall)], p(w, y, z0), p(w, y, z1), p(w, ridge, m), 2.0f, tint);
  add_triangle(meshes[static_cast<size_t>(wall)], p(0, y, z1), p(0, y, z0), p(0, ridge, m), 2.0f, tint);
}

}  // namespace

Scene make_facade(const std::vector<double>& values) {
  const int detail = static_cast<int>(values[0]);
  SceneBuilder builder("facade");
  const Texture bricks = paint_bricks();
  builder.add_material(bricks, 0.85f);
  builder.material(wall_brick).normal_texture = builder.add_texture(normal_map(bricks, 4.0f));
  builder.add_material(paint_plaster(), 0.9f);
  builder.add_material(paint_plaster_windows(), 0.8f);
  builder.add_material(paint_shopfront(), 0.6f);
  builder.add_material(paint_concrete(), 0.8f);
  builder.add_material(paint_roof_tiles(), 0.8f);
  builder.add_material(paint_pavement(), 0.9f);
  builder.add_material(paint_stone(), 0.9f);
  builder.add_material(paint_glass_front(), 0.2f, 0.3f);

  std::array<Mesh, material_count> meshes;
  Random random(7);
  const float length = house_width * houses, edge = 0.5f * street_width, kerb = 0.12f;
  for (int i = 0; i < houses; ++i) {
    const float along = house_width * static_cast<float>(i);
    add_house(meshes, random, {{-edge, kerb, -along}, {0, 0, -1}, {-1, 0, 0}}, detail);
    add_house(meshes, random, {{edge, kerb, -length + along}, {0, 0, 1}, {1, 0, 0}}, detail);
  }
  const Frame start{{0.0f, 0.0f, 0.0f}, {1, 0, 0}, {0, 0, -1}};
  add_box(meshes[paving], start, {-edge, -0.2f, 0.0f}, {-edge + 1.8f, kerb, length}, 2.0f, white, sides_no_bottom);
  add_box(meshes[paving], start, {edge - 1.8f, -0.2f, 0.0f}, {edge, kerb, length}, 2.0f, white, sides_no_bottom);
  add_floor(meshes[street], {-80.0f, 0.0f, -length - 80.0f}, {80.0f, 0.0f, 80.0f}, 4.0f);

  std::vector<int> indices;
  for (size_t m = 0; m < meshes.size(); ++m) {
    if (meshes[m].triangles.empty()) continue;
    meshes[m].material = static_cast<int>(m);
    meshes[m].name = builder.material(static_cast<int>(m)).name;
    indices.push_back(builder.add_mesh(std::move(meshes[m])));
  }
  builder.place("street", indices);
  builder.add_sun({-0.45, -0.8, -0.35}, glm::vec3(3.0f, 2.85f, 2.6f));
  builder.set_ambient({0.38f, 0.41f, 0.46f});
  return builder.finish({0.6, 1.8, -3.0}, {0.0, 3.6, -30.0});
}

}  // namespace omma::builtin
