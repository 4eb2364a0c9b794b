#include "tests/gpu/random_scenes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "omma/math/heading.h"
#include "tests/gpu/hand_made.h"

namespace omma {

Scene random_soup(int triangles, unsigned seed, float unit) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> exponent(-2.0f, 1.5f);
  SceneMaker maker;
  for (const bool double_sided : {false, true}) {
    Material material;
    material.double_sided = double_sided;
    Mesh mesh;
    mesh.material = maker.add(material);
    for (int t = 0; t < triangles / 2; ++t) {
      const glm::vec3 middle = 4.0f * glm::vec3(normal(random), normal(random), normal(random));
      const float size = std::pow(10.0f, exponent(random));
      const auto first = uint32_t(mesh.positions.size());
      for (int c = 0; c < 3; ++c) {
        mesh.positions.push_back(unit * (middle + size * glm::vec3(normal(random), normal(random), normal(random))));
      }
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    const int number = maker.add(mesh);
    maker.place(number, glm::dmat4(1.0));
    if (!double_sided) {
      // Mirrored, sheared and elsewhere.
      glm::dmat4 elsewhere = glm::translate(glm::dmat4(1.0), double(unit) * glm::dvec3(1.0, -2.0, 0.5));
      elsewhere[0] = {-1.2, 0.1, 0.0, 0.0};
      elsewhere[1] = {0.3, 0.9, -0.2, 0.0};
      maker.place(number, elsewhere);
    }
  }
  return maker.finish();
}

Scene dented_ball(unsigned seed, const Material& material) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> dent(0.4f, 1.6f);
  constexpr uint32_t around = 48, down = 24;
  Mesh mesh;
  for (uint32_t j = 0; j <= down; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double longitude = 6.283185307179586 * i / around, colatitude = 3.14159265358979 * j / down;
      mesh.positions.emplace_back(std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
                                  std::sin(colatitude) * std::cos(longitude));
      if (j == 0) mesh.positions.back() = {0, 1, 0};
      if (j == down) mesh.positions.back() = {0, -1, 0};
    }
  }
  const auto corner = [&](uint32_t i, uint32_t j) {
    return j == 0 ? 0 : j == down ? down * around : j * around + i % around;
  };
  for (glm::vec3& p : mesh.positions) p *= dent(random);  // along the ray, so that every ray still meets one triangle
  for (uint32_t j = 0; j < down; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      if (j > 0) mesh.triangles.emplace_back(corner(i, j), corner(i + 1, j), corner(i, j + 1));
      if (j + 1 < down) mesh.triangles.emplace_back(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  SceneMaker maker;
  mesh.material = maker.add(material);
  maker.place(maker.add(mesh), glm::dmat4(1.0));
  return maker.finish();
}

glm::dmat4 pose_within(const Bounds& bounds, std::mt19937& random) {
  std::uniform_real_distribution<double> inside(0.02, 0.98);
  std::normal_distribution<double> normal;
  glm::dmat4 pose =
      glm::mat4_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
  const glm::dvec3 share(inside(random), inside(random), inside(random));
  pose[3] = glm::dvec4(bounds.min + share * bounds.extent(), 1.0);
  return pose;
}

glm::dmat4 pose_at(const glm::dvec3& place, double yaw, double pitch) {
  glm::dmat4 pose(rotation_of({.yaw = yaw, .pitch = pitch, .roll = 0.3}));
  pose[3] = glm::dvec4(place, 1.0);
  return pose;
}

}  // namespace omma
