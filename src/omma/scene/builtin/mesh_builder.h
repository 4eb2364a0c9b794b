// Solids for the built-in scenes: triangles counter-clockwise from outside, normals outward, uvs in textures.
#pragma once

#include <span>
#include <string>

#include "omma/scene/scene.h"

namespace omma::builtin {

/// Linear colour that multiplies a material's.
using Tint = glm::u8vec4;
inline constexpr Tint white{255, 255, 255, 255};

/// A place on the ground with its own axes, so that a house can face any street: x to the right as seen from in front
/// of it, y up, z away from the viewer.
struct Frame {
  glm::vec3 origin{0.0f};
  glm::vec3 right{1.0f, 0.0f, 0.0f};
  glm::vec3 back{0.0f, 0.0f, -1.0f};

  glm::vec3 direction(float x, float y, float z) const { return right * x + glm::vec3(0.0f, y, 0.0f) + back * z; }
  glm::vec3 point(float x, float y, float z) const { return origin + direction(x, y, z); }
  Frame at(float x, float y, float z) const { return {point(x, y, z), right, back}; }
};

/// Texture coordinates of a quad: (0, 0) is its top left corner.
struct UvRect {
  float u0 = 0.0f, v0 = 0.0f, u1 = 1.0f, v1 = 1.0f;
};

/// Corners from the bottom left, counter-clockwise as seen from outside. Flat normal.
void add_quad(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
              const UvRect& uv, Tint tint = white);

/// Counter-clockwise as seen from outside. The uvs are metres over `metres`, along ab and across it.
void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float metres,
                  Tint tint = white);

/// An upward quad at the height of `a`, from corner (a.x, a.z) to (b.x, b.z), uvs in metres over `metres`.
void add_floor(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, float metres, Tint tint = white);

enum Sides : unsigned {
  side_front = 1,
  side_right = 2,
  side_back = 4,
  side_left = 8,
  side_top = 16,
  side_bottom = 32,
  sides_walls = 15,
  sides_all = 63,
  sides_no_bottom = 31
};

/// A box between two corners of the frame; one texture covers `metres`.
void add_box(Mesh& mesh, const Frame& frame, const glm::vec3& low, const glm::vec3& high, float metres,
             Tint tint = white, unsigned sides = sides_all);

/// Four walls whose texture repeats a whole number of times: `columns` a metre and `rows` in all.
void add_walls(Mesh& mesh, const Frame& frame, const glm::vec3& low, const glm::vec3& high, float columns, float rows,
               Tint tint = white);

/// A profile of (radius, height), from the bottom, turned around the y axis at `center`. Smooth along the profile where
/// it bends by less than 40 degrees. A radius of zero closes an end.
void add_lathe(Mesh& mesh, const glm::vec3& center, std::span<const glm::vec2> profile, int segments, float u_repeat,
               Tint tint = white);

/// An icosahedron split `levels` times, radius varied by up to `roughness` of it (0: a sphere), stretched by `radii`.
void add_ball(Mesh& mesh, const glm::vec3& center, const glm::vec3& radii, int levels, float roughness, uint64_t seed,
              Tint tint = white);

void add_torus(Mesh& mesh, const glm::vec3& center, float radius, float tube, int segments, int tube_segments,
               Tint tint = white);

/// Adds textures, materials and placed meshes to a scene.
class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name) { scene_.name = std::move(name); }

  int add_texture(Texture texture);
  /// A material called as its texture.
  int add_material(Texture texture, float roughness, float metallic = 0.0f);
  int add_material(Material material);
  Material& material(int index) { return scene_.materials[index]; }
  int add_mesh(Mesh mesh);
  /// A new object.
  void place(std::string name, std::span<const int> meshes, const glm::dvec3& translation = {}, double turn = 0.0);
  void add_sun(const glm::dvec3& direction, const glm::vec3& irradiance);
  void add_lamp(std::string name, const glm::dvec3& position, const glm::vec3& intensity);
  void set_ambient(const glm::vec3& radiance) { scene_.ambient = radiance; }
  Scene finish(const glm::dvec3& from, const glm::dvec3& to);

 private:
  Scene scene_;
};

}  // namespace omma::builtin
