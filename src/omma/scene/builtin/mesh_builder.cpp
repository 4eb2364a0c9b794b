#include "omma/scene/builtin/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "omma/scene/builtin/random.h"
#include "omma/scene/geometry.h"

namespace omma::builtin {
namespace {

constexpr float pi = 3.14159265f;

uint32_t add_vertex(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv, Tint tint) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.uvs.push_back(uv);
  mesh.colors.push_back(tint);
  return static_cast<uint32_t>(mesh.positions.size() - 1);
}

/// Two triangles over a grid of vertices, rows of `columns` + 1, counter-clockwise when rows go up and columns to the
/// right.
void add_grid(Mesh& mesh, uint32_t first, int columns, int rows, const auto& is_degenerate) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto at = [&](int c, int r) {
        return first + static_cast<uint32_t>((row + r) * (columns + 1) + column + c);
      };
      if (!is_degenerate(row)) mesh.triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
      if (!is_degenerate(row + 1)) mesh.triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
    }
  }
}

}  // namespace

void add_quad(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
              const UvRect& uv, Tint tint) {
  const glm::vec3 normal = glm::normalize(glm::cross(c - a, d - b));
  const uint32_t i = add_vertex(mesh, a, normal, {uv.u0, uv.v1}, tint);
  add_vertex(mesh, b, normal, {uv.u1, uv.v1}, tint);
  add_vertex(mesh, c, normal, {uv.u1, uv.v0}, tint);
  add_vertex(mesh, d, normal, {uv.u0, uv.v0}, tint);
  mesh.triangles.emplace_back(i, i + 1, i + 2);
  mesh.triangles.emplace_back(i, i + 2, i + 3);
}

void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float metres, Tint tint) {
  const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const glm::vec3 u = glm::normalize(b - a), v = glm::cross(normal, u);
  const auto uv = [&](const glm::vec3& p) { return glm::vec2(glm::dot(p - a, u), -glm::dot(p - a, v)) / metres; };
  const uint32_t i = add_vertex(mesh, a, normal, uv(a), tint);
  add_vertex(mesh, b, normal, uv(b), tint);
  add_vertex(mesh, c, normal, uv(c), tint);
  mesh.triangles.emplace_back(i, i + 1, i + 2);
}

void add_floor(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, float metres, Tint tint) {
  const float x0 = std::min(a.x, b.x), x1 = std::max(a.x, b.x);
  const float z0 = std::min(a.z, b.z), z1 = std::max(a.z, b.z);
  add_quad(mesh, {x0, a.y, z1}, {x1, a.y, z1}, {x1, a.y, z0}, {x0, a.y, z0},
           {x0 / metres, z0 / metres, x1 / metres, z1 / metres}, tint);
}

void add_box(Mesh& mesh, const Frame& frame, const glm::vec3& low, const glm::vec3& high, float metres, Tint tint,
             unsigned sides) {
  const glm::vec3 size = (high - low) / metres;
  const auto quad = [&](unsigned side, const std::array<glm::vec3, 4>& p, float u, float v) {
    if (!(sides & side)) return;
    const auto world = [&](const glm::vec3& q) { return frame.point(q.x, q.y, q.z); };
    add_quad(mesh, world(p[0]), world(p[1]), world(p[2]), world(p[3]), {0.0f, 0.0f, u, v}, tint);
  };
  const glm::vec3 l = low, h = high;
  quad(side_front, {{{l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z}}}, size.x, size.y);
  quad(side_right, {{{h.x, l.y, l.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}}}, size.z, size.y);
  quad(side_back, {{{h.x, l.y, h.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z}}}, size.x, size.y);
  quad(side_left, {{{l.x, l.y, h.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {l.x, h.y, h.z}}}, size.z, size.y);
  quad(side_top, {{{l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z}}}, size.x, size.z);
  quad(side_bottom, {{{l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, l.y, l.z}, {l.x, l.y, l.z}}}, size.x, size.z);
}

void add_walls(Mesh& mesh, const Frame& frame, const glm::vec3& low, const glm::vec3& high, float columns, float rows,
               Tint tint) {
  const glm::vec2 corners[] = {{low.x, low.z}, {high.x, low.z}, {high.x, high.z}, {low.x, high.z}};
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 p = corners[i], q = corners[(i + 1) % 4];
    const float repeats = std::max(0.25f, std::round(4.0f * columns * glm::length(q - p)) / 4.0f);
    add_quad(mesh, frame.point(p.x, low.y, p.y), frame.point(q.x, low.y, q.y), frame.point(q.x, high.y, q.y),
             frame.point(p.x, high.y, p.y), {0.0f, 0.0f, repeats, rows}, tint);
  }
}

void add_lathe(Mesh& mesh, const glm::vec3& center, std::span<const glm::vec2> profile, int segments, float u_repeat,
               Tint tint) {
  const auto along = [&](size_t i) { return glm::normalize(profile[i + 1] - profile[i]); };
  const float length = [&] {
    float sum = 0.0f;
    for (size_t i = 0; i + 1 < profile.size(); ++i) sum += glm::length(profile[i + 1] - profile[i]);
    return sum;
  }();
  float travelled = 0.0f;
  const float smooth = std::cos(40.0f * pi / 180.0f);
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    const float step = glm::length(profile[i + 1] - profile[i]);
    // The tangent of the profile at both ends of this band.
    glm::vec2 tangents[2] = {along(i), along(i)};
    if (i > 0 && glm::dot(along(i - 1), along(i)) > smooth) tangents[0] = along(i - 1) + along(i);
    if (i + 2 < profile.size() && glm::dot(along(i + 1), along(i)) > smooth) {
      tangents[1] = along(i + 1) + along(i);
    }
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int end = 0; end < 2; ++end) {
      const glm::vec2 point = profile[i + static_cast<size_t>(end)];
      const glm::vec2 tangent = glm::normalize(tangents[end]);
      for (int s = 0; s <= segments; ++s) {
        // The last column is the first again, bit by bit, or the seam would leak.
        const float angle = 2.0f * pi * static_cast<float>(s % segments) / static_cast<float>(segments);
        const float sine = std::sin(angle), cosine = std::cos(angle);
        add_vertex(mesh, center + glm::vec3(sine * point.x, point.y, cosine * point.x),
                   glm::vec3(sine * tangent.y, -tangent.x, cosine * tangent.y),
                   {u_repeat * static_cast<float>(s) / static_cast<float>(segments),
                    1.0f - (travelled + step * static_cast<float>(end)) / length},
                   tint);
      }
    }
    add_grid(mesh, first, segments, 1, [&](int row) { return profile[i + static_cast<size_t>(row)].x == 0.0f; });
    travelled += step;
  }
}

void add_ball(Mesh& mesh, const glm::vec3& center, const glm::vec3& radii, int levels, float roughness, uint64_t seed,
              Tint tint) {
  const float g = 1.618034f;
  std::vector<glm::vec3> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::vec3& p : points) p = glm::normalize(p);
  std::vector<glm::uvec3> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [entry, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(points.size()));
      if (fresh) points.push_back(glm::normalize(points[a] + points[b]));
      return entry->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : triangles) {
      const uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
      finer.insert(finer.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  Random random(seed);
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (const glm::vec3& p : points) {
    const float radius = 1.0f + roughness * random.between(-1.0f, 1.0f);
    // Seen from above and from the side the picture repeats without a seam at ±180°, at the price of a mirrored half.
    const glm::vec2 uv(std::abs(std::atan2(p.x, p.z)) / pi * 2.0f, std::acos(std::clamp(p.y, -1.0f, 1.0f)) / pi * 2.0f);
    add_vertex(mesh, center + p * radii * radius, glm::normalize(p / radii), uv, tint);
  }
  for (const glm::uvec3& t : triangles) mesh.triangles.push_back(t + first);
}

void add_torus(Mesh& mesh, const glm::vec3& center, float radius, float tube, int segments, int tube_segments,
               Tint tint) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (int t = 0; t <= tube_segments; ++t) {
    const float b = 2.0f * pi * static_cast<float>(t % tube_segments) / static_cast<float>(tube_segments);
    for (int s = 0; s <= segments; ++s) {
      const float a = 2.0f * pi * static_cast<float>(s % segments) / static_cast<float>(segments);
      const glm::vec3 outward(std::sin(a), 0.0f, std::cos(a));
      const glm::vec3 normal = outward * std::cos(b) + glm::vec3(0.0f, std::sin(b), 0.0f);
      add_vertex(mesh, center + outward * radius + normal * tube, normal,
                 {8.0f * static_cast<float>(s) / static_cast<float>(segments),
                  -2.0f * static_cast<float>(t) / static_cast<float>(tube_segments)},
                 tint);
    }
  }
  add_grid(mesh, first, segments, tube_segments, [](int) { return false; });
}

int SceneBuilder::add_texture(Texture texture) {
  scene_.textures.push_back(std::move(texture));
  return static_cast<int>(scene_.textures.size()) - 1;
}

int SceneBuilder::add_material(Texture texture, float roughness, float metallic) {
  Material result;
  result.name = texture.name;
  result.roughness = roughness;
  result.metallic = metallic;
  result.base_color_texture = add_texture(std::move(texture));
  return add_material(std::move(result));
}

int SceneBuilder::add_material(Material material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<int>(scene_.materials.size()) - 1;
}

int SceneBuilder::add_mesh(Mesh mesh) {
  if (scene_.materials[mesh.material].normal_texture >= 0) generate_tangents(mesh);
  scene_.meshes.push_back(std::move(mesh));
  return static_cast<int>(scene_.meshes.size()) - 1;
}

void SceneBuilder::place(std::string name, std::span<const int> meshes, const glm::dvec3& translation, double turn) {
  Node node;
  node.name = std::move(name);
  node.translation = translation;
  node.rotation = glm::angleAxis(turn, glm::dvec3(0.0, 1.0, 0.0));
  scene_.nodes.push_back(std::move(node));
  const int object = scene_.instances.empty() ? 0 : scene_.instances.back().object + 1;
  for (const int mesh : meshes) {
    Instance instance;
    instance.mesh = mesh;
    instance.node = static_cast<int>(scene_.nodes.size()) - 1;
    instance.object = object;
    scene_.instances.push_back(instance);
  }
}

void SceneBuilder::add_sun(const glm::dvec3& direction, const glm::vec3& irradiance) {
  Light light;
  light.kind = Light::Kind::sun;
  light.name = "sun";
  light.direction = glm::normalize(direction);
  light.color = irradiance;
  scene_.lights.push_back(std::move(light));
}

void SceneBuilder::add_lamp(std::string name, const glm::dvec3& position, const glm::vec3& intensity) {
  Light light;
  light.kind = Light::Kind::point;
  light.name = std::move(name);
  light.position = position;
  light.color = intensity;
  scene_.lights.push_back(std::move(light));
}

Scene SceneBuilder::finish(const glm::dvec3& from, const glm::dvec3& to) {
  scene_.default_from = from;
  scene_.default_to = to;
  finish_scene(scene_);
  return std::move(scene_);
}

}  // namespace omma::builtin
