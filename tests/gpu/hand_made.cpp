#include "tests/gpu/hand_made.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace omma {

SceneMaker::SceneMaker() {
  scene_.name = "hand-made";
  scene_.ambient = glm::vec3(0.0f);
}

int SceneMaker::add(Material material) {
  scene_.materials.push_back(std::move(material));
  return int(scene_.materials.size()) - 1;
}

int SceneMaker::add(Texture texture) {
  scene_.textures.push_back(std::move(texture));
  return int(scene_.textures.size()) - 1;
}

int SceneMaker::add(Mesh mesh) {
  scene_.meshes.push_back(std::move(mesh));
  return int(scene_.meshes.size()) - 1;
}

int SceneMaker::place(int mesh, const glm::dmat4& worldFromObject) {
  Node node;
  node.matrix = worldFromObject;
  scene_.nodes.push_back(node);
  const int number = int(scene_.nodes.size()) - 1;
  Instance instance;
  instance.mesh = mesh;
  instance.node = number;
  instance.object = number;
  scene_.instances.push_back(instance);
  return number;
}

Scene SceneMaker::finish() {
  finish_scene(scene_);
  return std::move(scene_);
}

Mesh make_quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {a, b, c, d};
  mesh.normals.assign(4, glm::normalize(glm::cross(b - a, c - a)));
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh make_pane(float z, float half, int material) {
  Mesh mesh = make_quad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}, material);
  for (glm::vec2& uv : mesh.uvs) uv.y = 1.0f - uv.y;
  return mesh;
}

Mesh make_ball(float radius, int material) {
  constexpr int around = 12, down = 8;
  Mesh mesh;
  mesh.material = material;
  for (int j = 0; j <= down; ++j) {
    for (int i = 0; i <= around; ++i) {
      const float u = float(i) / around, v = float(j) / down;
      const float longitude = 2.0f * glm::pi<float>() * u, colatitude = glm::pi<float>() * v;
      const glm::vec3 normal(std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
                             std::sin(colatitude) * std::cos(longitude));
      mesh.positions.push_back(radius * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(u, v);
    }
  }
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < around; ++i) {
      const auto corner = uint32_t(j * (around + 1) + i), below = corner + around + 1;
      if (j > 0) mesh.triangles.emplace_back(corner, below, corner + 1);
      if (j + 1 < down) mesh.triangles.emplace_back(corner + 1, below, below + 1);
    }
  }
  return mesh;
}

Material unlit(const glm::vec4& color) {
  Material material;
  material.base_color = color;
  material.unlit = true;
  return material;
}

glm::dmat4 translation(const glm::dvec3& by) { return glm::translate(glm::dmat4(1.0), by); }

Scene make_ball_and_pane() {
  SceneMaker maker;
  maker.place(maker.add(make_ball(1.0f, maker.add(unlit({1, 0, 0, 1})))), translation({0, 0, -4}));
  maker.place(maker.add(make_pane(-6.0f, 3.0f, maker.add(unlit({0, 1, 0, 1})))));
  return maker.finish();
}

SceneChanges move_ball(Scene& scene, int frame, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  const double x = place(random), y = place(random), z = place(random) - 5.0;
  scene.instances[0].worldFromObject =
      glm::scale(translation({x, y, z}), glm::dvec3(frame % 2 == 0 ? 1.0 : -1.0, 1.0, 1.0));
  return {.moved = true};
}

}  // namespace omma
