// Hours of a viewer in short: cameras and a scene that change with every frame leave memory where it was.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <random>

#include "omma/math/pose.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/proof.h"

namespace omma {
namespace {

/// Megabytes of this process in memory; 0 where the system does not say.
double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * 4096.0 * 1e-6;
}

class SoakTest : public GpuTest {};

TEST_F(SoakTest, CamerasAndASceneThatChangeLeaveMemoryWhereItWas) {
  // Programs that OpenGL compiles, one after another as cameras and shadows call for them, are most of the time: in the
  // full proof alone.
  const bool by_gl = full_proof();
  const int frames = by_gl ? 10000 : 600;
  Scene scene = load_scene("room");
  const int ball = int(scene.meshes.size());
  scene.meshes.push_back(make_ball(0.2f, 0));
  PreparedScene prepared(device(), std::move(scene));
  std::mt19937 random(4);
  const auto uniform = [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
  std::vector<uint32_t> balls;
  double warm = 0.0;
  size_t hits = 0;
  for (int frame = 0; frame < frames; ++frame) {
    prepared.edit([&](SceneEdit& edit) {
      balls.push_back(edit.add_instance(ball, translation({uniform(), 1.0 + uniform(), uniform()}), 900));
      if (balls.size() > 12) {
        edit.remove_instance(balls[random() % 12]);
        std::erase_if(balls, [&](uint32_t key) {
          return std::ranges::find(edit.scene().instances, key, &Instance::key) == edit.scene().instances.end();
        });
      }
      edit.move(balls.back(), translation({uniform(), 1.5, uniform()}));
      std::vector<glm::vec3> positions = edit.scene().meshes[size_t(ball)].positions;
      for (glm::vec3& p : positions) p *= 1.0f + 0.01f * float(uniform());
      edit.set_vertices(ball, positions);
      if (frame % 20 == 0) edit.replace_mesh(ball, make_ball(0.2f, 0));
      Material material = edit.scene().materials[0];
      material.base_color.x = float(0.5 + 0.5 * uniform());
      edit.set_material(0, material);
    });
    // Other lenses, sizes and forms, so that everything that is kept for the last few is pushed out again.
    const ImageSize size{48 + frame % 40, 40};
    const Camera camera = frame % 9 == 8
                              ? wavy_ray_map(40)
                              : make_camera(frame % 2 == 0 ? "equirectangular" : "equidistant:fov_deg=180", size);
    const glm::dmat4 pose = look_at_worldFromCamera({uniform(), 1.2, uniform()}, {0.0, 1.0, -3.0});
    const Channel wanted[] = {Channel::color, Channel::object};
    RenderOptions options{.technique = "visibility:cpu", .samples = 1 + frame % 4};
    if (by_gl && frame % 10 == 0) options.technique = frame % 20 == 0 ? "visibility:resolve" : "nonlinear";
    if (frame % 15 == 0) options.shadows = Shadows::paraboloid;
    options.shadow_size = 64;
    const auto pictures = prepared.render(camera, pose, wanted, options);
    for (const int32_t object : std::get<IntImage>(pictures.at(Channel::object)).values) hits += object == 900;
    if (frame == frames / 3) warm = resident_mb();
  }
  EXPECT_GT(hits, size_t(frames));
  const double grown = resident_mb() - warm;
  std::cout << frames << " frames, " << warm << " MB after a third, " << grown << " MB more at the end\n";
  EXPECT_LT(grown, 4.0);
}

}  // namespace
}  // namespace omma
