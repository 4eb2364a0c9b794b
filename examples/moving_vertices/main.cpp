// A host with a simulation of its own: cloth whose vertices it moves, balls that it throws in and takes out again, a
// lamp that changes colour. Nothing is loaded again. Writes a picture of every tenth step: moving_vertices FOLDER
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/image/write.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"

namespace {

constexpr int side = 40;  ///< vertices along the cloth

/// Waves that run over the cloth.
std::vector<glm::vec3> cloth_at(double time) {
  std::vector<glm::vec3> positions;
  for (int z = 0; z < side; ++z) {
    for (int x = 0; x < side; ++x) {
      const double u = 6.0 * x / (side - 1) - 3.0, v = 6.0 * z / (side - 1) - 3.0;
      positions.emplace_back(u, 0.3 * std::sin(2.0 * u + 3.0 * time) * std::cos(1.5 * v), v);
    }
  }
  return positions;
}

omma::Mesh make_cloth(int material) {
  omma::Mesh mesh;
  mesh.name = "cloth";
  mesh.material = material;
  mesh.positions = cloth_at(0.0);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 1.0f, 0.0f));
  for (uint32_t z = 0; z + 1 < side; ++z) {
    for (uint32_t x = 0; x + 1 < side; ++x) {
      const uint32_t corner = z * side + x;
      mesh.triangles.emplace_back(corner, corner + side, corner + 1);
      mesh.triangles.emplace_back(corner + 1, corner + side, corner + side + 1);
    }
  }
  return mesh;
}

/// An octahedron is ball enough here.
omma::Mesh make_ball(int material) {
  omma::Mesh mesh;
  mesh.name = "ball";
  mesh.material = material;
  mesh.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const glm::vec3& normal : mesh.normals) mesh.positions.push_back(0.3f * normal);
  mesh.triangles = {{0, 2, 4}, {4, 2, 1}, {1, 2, 5}, {5, 2, 0}, {0, 4, 3}, {4, 1, 3}, {1, 5, 3}, {5, 0, 3}};
  return mesh;
}

glm::dmat4 at(const glm::dvec3& place) {
  glm::dmat4 transform(1.0);
  transform[3] = glm::dvec4(place, 1.0);
  return transform;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: moving_vertices FOLDER\n");
    return 2;
  }
  try {
    omma::PreparedScene scene{omma::Device(), omma::Scene()};  // everything comes from the host
    int cloth = 0, ball = 0;
    scene.edit([&](omma::SceneEdit& edit) {
      omma::Material red, blue;
      red.base_color = {0.8f, 0.15f, 0.1f, 1.0f};
      red.double_sided = true;
      blue.base_color = {0.1f, 0.2f, 0.8f, 1.0f};
      cloth = edit.add_mesh(make_cloth(edit.add_material(red)));
      ball = edit.add_mesh(make_ball(edit.add_material(blue)));
      edit.add_instance(cloth, glm::dmat4(1.0), 0);
    });

    struct Thrown {
      uint32_t instance;
      double since;
    };
    std::deque<Thrown> thrown;
    const omma::Camera camera = omma::make_camera("stereographic:fov_deg=200", omma::ImageSize{320, 320});
    const glm::dmat4 pose = omma::look_at_worldFromCamera({0.0, 1.8, 3.0}, {0.0, 0.0, 0.0});
    for (int step = 0; step < 60; ++step) {
      const double time = step / 30.0;
      scene.edit([&](omma::SceneEdit& edit) {  // no picture has a part of it
        edit.set_vertices(cloth, cloth_at(time));
        if (step % 5 == 0) thrown.push_back({edit.add_instance(ball, at({0.0, 0.5, 0.0}), 1 + step / 5), time});
        if (thrown.size() > 6) {
          edit.remove_instance(thrown.front().instance);
          thrown.pop_front();
        }
        for (const Thrown& one : thrown) {
          const double t = time - one.since;
          edit.move(one.instance, at({3.0 * t * std::sin(9.0 * one.since), 0.5 + 3.0 * t - 4.9 * t * t, -2.0 * t}));
        }
        omma::Light lamp;
        lamp.kind = omma::Light::Kind::point;
        lamp.position = {1.0, 4.0, 2.0};
        lamp.color = glm::vec3(30.0f, 20.0f + 10.0f * float(std::sin(2.0 * time)), 20.0f);
        edit.set_lights({lamp});
      });
      if (step % 10 != 0) continue;
      const omma::Channel wanted[] = {omma::Channel::color};
      omma::RenderOptions options;
      options.shadows = omma::Shadows::paraboloid;
      const auto pictures = scene.render(camera, pose, wanted, options);
      const std::filesystem::path file = std::filesystem::path(argv[1]) / ("step_" + std::to_string(step) + ".png");
      omma::write_image(file, pictures.at(omma::Channel::color), omma::Channel::color);
      std::printf("%s: %d balls\n", file.c_str(), int(thrown.size()));
    }
  } catch (const omma::Error& error) {
    std::fprintf(stderr, "moving_vertices: %s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
