// In a closed room every pixel that has a ray meets something, wherever the camera stands, and no other pixel does.
#include <fmt/format.h>

#include <cstdlib>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "tests/gpu/gpu_test.h"

namespace omma {
namespace {

/// OMMA_FULL_PROOF=1 asks for a thousand poses, OMMA_PROOF_TECHNIQUE for one technique alone.
int pose_count() {
  const char* full = std::getenv("OMMA_FULL_PROOF");
  return full != nullptr && std::string(full) == "1" ? 1000 : 20;
}

glm::dmat4 random_pose(std::mt19937& random, const Bounds& bounds) {
  std::uniform_real_distribution<double> inside(0.02, 0.98);
  std::normal_distribution<double> normal;
  glm::dmat4 pose =
      glm::mat4_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
  const glm::dvec3 share(inside(random), inside(random), inside(random));
  pose[3] = glm::dvec4(bounds.min + share * bounds.extent(), 1.0);
  return pose;
}

bool has_ray_near(const Camera& camera, const glm::dvec2& pixel) {
  constexpr double radius = 1e-3;
  for (int side = 0; side < 9; ++side) {
    if (camera.unproject(pixel + radius * glm::dvec2(side % 3 - 1, side / 3 - 1))) return true;
  }
  return false;
}

class ClosedSceneTest : public GpuTest, public ::testing::WithParamInterface<size_t> {};

TEST_P(ClosedSceneTest, HasNoHoles) {
  const auto [name, camera] = all_cameras(120)[GetParam()];
  const Scene scene = load_scene("room");
  const Bounds bounds = scene.bounds();
  renderer().load(scene);
  std::vector<std::string> names;
  const char* only = std::getenv("OMMA_PROOF_TECHNIQUE");
  for (const std::string& technique : only != nullptr ? std::vector<std::string>{only} : distinct_technique_names()) {
    // Vertices alone do not make a closed picture.
    if (can_draw(technique, camera) && technique != "vertex") names.push_back(technique);
  }
  if (only == nullptr) {
    ASSERT_GE(names.size(), 2u);
  }
  size_t seen = 0, strays = 0;
  std::mt19937 random(17);
  for (int i = 0; i < pose_count(); ++i) {
    const glm::dmat4 pose = random_pose(random, bounds);
    for (const std::string& technique : names) {
      const IntImage ids = draw_ids(camera, pose, technique);
      size_t holes = 0;
      for (int y = 0; y < ids.size.height; ++y) {
        for (int x = 0; x < ids.size.width; ++x) {
          const glm::dvec2 pixel(x + 0.5, y + 0.5);
          const bool ray = camera.unproject(pixel).has_value(), hit = *ids.at(x, y) >= 0;
          seen += hit;
          if (ray && !hit) ++holes;
          // Single precision may see a ray on the very border of the image circle.
          if (!ray && hit && !has_ray_near(camera, pixel)) ++strays;
        }
      }
      EXPECT_EQ(holes, 0u) << technique << ", pose " << i;
    }
  }
  EXPECT_EQ(strays, 0u);
  EXPECT_GT(seen, size_t(pose_count()) * 1000u * names.size());
}

INSTANTIATE_TEST_SUITE_P(Cameras, ClosedSceneTest, ::testing::Range<size_t>(0, all_cameras(16).size()),
                         [](const auto& tested) { return test_name(all_cameras(16)[tested.param].name); });

}  // namespace
}  // namespace omma
