// A closed room: twelve triangles all around the camera, a table, and a few dense objects under two lamps.
#include <cmath>

#include "omma/scene/builtin/builtin.h"
#include "omma/scene/builtin/mesh_builder.h"
#include "omma/scene/builtin/procedural_texture.h"

namespace omma::builtin {
namespace {

enum RoomMaterial { walls, floor_boards, wood, marble, steel, clay, cloth, glow };

constexpr glm::vec3 half{4.0f, 1.5f, 3.0f};  // metres; the floor is at y = 0

/// Walls and ceiling, then the floor: one closed hull, seen from inside.
Mesh make_shell(bool is_floor) {
  Mesh mesh;
  mesh.name = is_floor ? "floor" : "walls and ceiling";
  mesh.material = is_floor ? floor_boards : walls;
  const float x = half.x, y = 2.0f * half.y, z = half.z;
  if (is_floor) {
    add_floor(mesh, {-x, 0.0f, -z}, {x, 0.0f, z}, 2.0f);
    return mesh;
  }
  const auto wall = [&](const glm::vec3& a, const glm::vec3& b, Tint tint) {
    const float length = glm::length(b - a);
    add_quad(mesh, a, b, b + glm::vec3(0, y, 0), a + glm::vec3(0, y, 0), {0.0f, 0.0f, length / 2.0f, y / 2.0f}, tint);
  };
  wall({-x, 0, -z}, {x, 0, -z}, Tint(235, 225, 205, 255));
  wall({x, 0, -z}, {x, 0, z}, Tint(150, 180, 200, 255));
  wall({x, 0, z}, {-x, 0, z}, Tint(235, 225, 205, 255));
  wall({-x, 0, z}, {-x, 0, -z}, Tint(205, 140, 110, 255));
  add_quad(mesh, {-x, y, -z}, {x, y, -z}, {x, y, z}, {-x, y, z}, {0.0f, 0.0f, x, z});
  return mesh;
}

Mesh make_furniture() {
  Mesh mesh;
  mesh.name = "table, shelf and stool";
  mesh.material = wood;
  const Frame room{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}};
  const Frame table = room.at(-1.1f, 0.0f, 0.9f);
  add_box(mesh, table, {0.0f, 0.72f, 0.0f}, {2.2f, 0.78f, 1.1f}, 1.5f);
  for (const float x : {0.08f, 2.04f}) {
    for (const float z : {0.08f, 0.94f})
      add_box(mesh, table, {x, 0.0f, z}, {x + 0.08f, 0.72f, z + 0.08f}, 1.5f, white, sides_walls);
  }
  const Frame shelf = room.at(-3.6f, 0.0f, 2.6f);
  for (int i = 0; i < 4; ++i) {
    const float y = 0.35f + 0.5f * static_cast<float>(i);
    add_box(mesh, shelf, {0.05f, y, 0.0f}, {1.75f, y + 0.04f, 0.38f}, 1.5f);
  }
  add_box(mesh, shelf, {0.0f, 0.0f, 0.0f}, {0.05f, 2.1f, 0.38f}, 1.5f, white, sides_no_bottom);
  add_box(mesh, shelf, {1.75f, 0.0f, 0.0f}, {1.8f, 2.1f, 0.38f}, 1.5f, white, sides_no_bottom);
  const glm::vec2 stool[] = {{0.05f, 0.0f}, {0.05f, 0.45f}, {0.22f, 0.45f}, {0.22f, 0.5f}, {0.0f, 0.5f}};
  add_lathe(mesh, {1.9f, 0.0f, 0.6f}, stool, 24, 3.0f);
  return mesh;
}

/// A pot: foot, belly, neck, rim, and down again inside, every band eight times finer than its outline.
Mesh make_pot() {
  Mesh mesh;
  mesh.name = "pot";
  mesh.material = clay;
  const glm::vec2 outline[] = {{0.0f, 0.0f},   {0.13f, 0.0f},  {0.20f, 0.12f}, {0.24f, 0.26f},
                               {0.17f, 0.42f}, {0.10f, 0.50f}, {0.15f, 0.58f}, {0.13f, 0.57f},
                               {0.08f, 0.50f}, {0.15f, 0.40f}, {0.20f, 0.26f}, {0.0f, 0.06f}};
  std::vector<glm::vec2> profile;
  const int count = static_cast<int>(std::size(outline));
  const auto point = [&](int i) { return outline[std::min(std::max(i, 0), count - 1)]; };
  constexpr int finer = 8;
  for (int i = 0; i + 1 < count; ++i) {
    // Catmull-Rom between outline points, straight along the foot and at the bottom inside.
    const bool straight = i == 0 || i + 2 == count;
    for (int k = 0; k < finer; ++k) {
      const float t = static_cast<float>(k) / finer;
      const glm::vec2 a = point(i - 1), b = point(i), c = point(i + 1), d = point(i + 2);
      profile.push_back(straight ? glm::mix(b, c, t)
                                 : 0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t +
                                           (3.0f * b - a - 3.0f * c + d) * t * t * t));
    }
  }
  profile.push_back(outline[count - 1]);
  add_lathe(mesh, {-0.75f, 0.78f, -1.4f}, profile, 48, 3.0f);
  return mesh;
}

Mesh named(const char* name, int material) {
  Mesh mesh;
  mesh.name = name;
  mesh.material = material;
  return mesh;
}

}  // namespace

Scene make_room(const std::vector<double>&) {
  SceneBuilder builder("room");
  builder.add_material(paint_plaster(), 0.9f);
  builder.add_material(paint_checker(), 0.35f);
  const Texture planks = paint_wood();
  builder.add_material(planks, 0.6f);
  builder.material(wood).normal_texture = builder.add_texture(normal_map(planks, 3.0f));
  builder.add_material(paint_marble(), 0.3f);
  builder.add_material(paint_metal({0.84f, 0.86f, 0.88f}), 0.1f, 1.0f);
  Texture fired = paint_bark();
  fired.name = "clay";
  builder.add_material(std::move(fired), 0.5f);
  builder.material(clay).base_color = glm::vec4(1.0f, 0.62f, 0.45f, 1.0f);
  builder.add_material(paint_cloth(), 1.0f);
  Material lamp;
  lamp.name = "lamp";
  lamp.emissive = glm::vec3(4.0f, 3.6f, 2.9f);
  builder.add_material(lamp);

  const auto place = [&](Mesh mesh) {
    const std::string name = mesh.name;
    const int index = builder.add_mesh(std::move(mesh));
    builder.place(name, {&index, 1});
  };
  const int shell[] = {builder.add_mesh(make_shell(false)), builder.add_mesh(make_shell(true))};
  builder.place("room", shell);
  place(make_furniture());
  place(make_pot());
  Mesh ball = named("ball", marble);
  add_ball(ball, {0.1f, 1.10f, -1.5f}, glm::vec3(0.32f), 4, 0.0f, 1);
  place(std::move(ball));
  Mesh ring = named("ring", steel);
  add_torus(ring, {0.78f, 0.88f, -1.25f}, 0.22f, 0.10f, 64, 32);
  place(std::move(ring));
  Mesh rug = named("rug", cloth);
  const Frame room{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}};
  add_box(rug, room, {-1.9f, 0.0f, -1.6f}, {1.9f, 0.015f, 0.8f}, 3.8f, white, sides_no_bottom);
  place(std::move(rug));
  Mesh globes = named("lamps", glow);
  const glm::vec3 lamps[] = {{-1.6f, 2.55f, -0.6f}, {2.2f, 2.55f, 0.9f}};
  for (const glm::vec3& at : lamps) {
    add_ball(globes, at, glm::vec3(0.12f), 2, 0.0f, 1);
    builder.add_lamp("lamp", at, glm::vec3(5.2f, 4.6f, 3.7f));
  }
  place(std::move(globes));
  builder.set_ambient(glm::vec3(0.16f, 0.16f, 0.17f));
  return builder.finish({0.9, 1.6, 1.7}, {-0.1, 1.0, -1.5});
}

}  // namespace omma::builtin
