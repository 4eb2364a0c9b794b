// The plan of the city: streets, crossings, blocks.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "omma/scene/builtin/builtin.h"
#include "omma/scene/builtin/city.h"
#include "omma/scene/builtin/procedural_texture.h"

namespace omma::builtin {
namespace {

constexpr float street = 14.0f;   // metres, between kerbs
constexpr float block = 62.0f;    // metres along a block's side
constexpr float crossing = 3.0f;  // metres of a zebra crossing along the street
constexpr float road_repeat = 8.0f;
/// Blocks along the side of a group: large enough for few meshes, small enough that each is one place.
constexpr int group_side = 3;
/// The plain that the town stands on lies this much below its streets.
constexpr float plain_height = -0.12f;

void add_street(CityGroup& group, const Frame& frame) {
  const auto strip = [&](CityMaterial material, float z0, float z1, float v) {
    add_quad(group[material], frame.point(0, 0, z0), frame.point(street, 0, z0), frame.point(street, 0, z1),
             frame.point(0, 0, z1), {0.0f, 0.0f, 1.0f, v});
  };
  strip(CityMaterial::crossing, 0.0f, crossing, 1.0f);
  strip(CityMaterial::road, crossing, block - crossing, (block - 2.0f * crossing) / road_repeat);
  strip(CityMaterial::crossing, block - crossing, block, 1.0f);
}

/// Few and huge: the plain to the horizon, and the town's edge down to it.
Mesh make_plain(float half) {
  Mesh mesh;
  mesh.name = "plain";
  mesh.material = static_cast<int>(CityMaterial::grass);
  const float reach = half + 3000.0f;
  add_floor(mesh, {-reach, plain_height, -reach}, {reach, plain_height, reach}, 8.0f);
  const Frame middle{};
  add_box(mesh, middle, {-half, plain_height, -half}, {half, 0.0f, half}, 8.0f, white, sides_walls);
  return mesh;
}

/// In the order of CityMaterial.
struct Paint {
  Texture (*paint)();
  float roughness, metallic = 0.0f;
};
constexpr Paint paints[] = {
    {paint_road, 0.9f},
    {paint_asphalt, 0.9f},
    {paint_crossing, 0.9f},
    {paint_pavement, 0.9f},
    {paint_grass, 1.0f},
    {paint_brick_windows, 0.8f},
    {paint_plaster_windows, 0.8f},
    {paint_glass_front, 0.25f, 0.3f},
    {paint_concrete, 0.8f},
    {paint_roof_tiles, 0.8f},
    {paint_shopfront, 0.6f},
    {paint_bark, 1.0f},
    {paint_leaves, 0.9f},
    {[] {
       return paint_metal({0.34f, 0.36f, 0.38f});
     },
     0.5f, 0.5f},
};

void add_materials(SceneBuilder& builder) {
  std::vector<Texture> painted(std::size(paints));
  tbb::parallel_for(size_t{0}, painted.size(), [&](size_t i) { painted[i] = paints[i].paint(); });
  for (size_t i = 0; i < painted.size(); ++i) {
    builder.add_material(std::move(painted[i]), paints[i].roughness, paints[i].metallic);
  }
}

}  // namespace

Scene make_city(const std::vector<double>& values) {
  const int blocks = static_cast<int>(values[0]);
  const auto seed = static_cast<uint64_t>(values[1]);
  const float pitch = block + street;
  const float half = 0.5f * (static_cast<float>(blocks) * pitch + street);
  // Where the streets begin, the same float for all who meet there.
  const auto low = [&](int i) { return static_cast<float>(i) * pitch - half; };
  // x to the right, z away from the viewer: the frame of a street or block whose near left corner is given.
  const auto frame = [](float x, float z) { return Frame{{x, 0.0f, z}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}}; };

  SceneBuilder builder("city");
  add_materials(builder);
  const int groups = blocks / group_side + 1;
  for (int gz = 0; gz < groups; ++gz) {
    for (int gx = 0; gx < groups; ++gx) {
      CityGroup group;
      for (int j = gz * group_side; j < std::min((gz + 1) * group_side, blocks + 1); ++j) {
        for (int i = gx * group_side; i < std::min((gx + 1) * group_side, blocks + 1); ++i) {
          const float x = low(i), z = low(j);
          add_floor(group[CityMaterial::asphalt], {x, 0.0f, z}, {x + street, 0.0f, z + street}, 7.0f);
          if (j < blocks) add_street(group, frame(x, low(j + 1)));
          if (i < blocks) {
            add_street(group, Frame{{x + street, 0.0f, z}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}});
          }
          if (i < blocks && j < blocks) {
            Random random(seed * 1000003u + static_cast<uint64_t>(j) * 1009u + static_cast<uint64_t>(i));
            build_block(group, random, frame(x + street, low(j + 1)), block);
          }
        }
      }
      std::vector<int> meshes;
      for (size_t m = 0; m < group.meshes.size(); ++m) {
        Mesh& mesh = group.meshes[m];
        if (mesh.triangles.empty()) continue;
        mesh.material = static_cast<int>(m);
        mesh.name = fmt::format("{} {},{}", builder.material(mesh.material).name, gx, gz);
        meshes.push_back(builder.add_mesh(std::move(mesh)));
      }
      if (!meshes.empty()) builder.place(fmt::format("blocks {},{}", gx, gz), meshes);
    }
  }
  const int plain = builder.add_mesh(make_plain(half));
  builder.place("plain", {&plain, 1});
  builder.add_sun({-0.55, -0.75, -0.40}, glm::vec3(3.0f, 2.85f, 2.6f));
  builder.set_ambient({0.34f, 0.38f, 0.45f});
  // Eye height on the pavement's side of a street in the middle, looking along it.
  const double x = low(blocks / 2) + street * 0.68, z = low((blocks + 1) / 2) + pitch * 0.85;
  return builder.finish({x, 1.7, z}, {x - 2.0, 3.2, z - 40.0});
}

}  // namespace omma::builtin
