// In a closed room every pixel that has a ray meets something, wherever the camera stands, and no other pixel does.
#include <fmt/core.h>

#include <cstdlib>
#include <random>

#include "tests/gpu/gpu_test.h"
#include "tests/gpu/random_scenes.h"
#include "tests/proof.h"

namespace omma {
namespace {

/// The environment variable OMMA_PROOF_TECHNIQUE asks for one technique alone.
std::vector<std::string> names_of_techniques() {
  const char* only = std::getenv("OMMA_PROOF_TECHNIQUE");
  return only != nullptr ? std::vector<std::string>{only} : distinct_technique_names();
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
  prepare(scene);
  std::vector<std::string> able, names;
  for (const std::string& technique : names_of_techniques()) {
    // Vertices alone do not make a closed picture.
    if (can_draw(technique, camera) && technique != "vertex") able.push_back(technique);
  }
  for (size_t i = 0; i < able.size(); ++i) {
    if (is_proved_today(GetParam(), i, able.size())) names.push_back(able[i]);
  }
  if (names.empty()) GTEST_SKIP() << "refused";
  size_t seen = 0, strays = 0;
  std::mt19937 random(17);
  const int poses = full_proof() ? 1000 : 20;
  for (int i = 0; i < poses; ++i) {
    const glm::dmat4 pose = pose_within(bounds, random);
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
  EXPECT_GT(seen, size_t(poses) * 1000u * names.size());
}

INSTANTIATE_TEST_SUITE_P(Cameras, ClosedSceneTest, ::testing::Range<size_t>(0, all_cameras(16).size()),
                         [](const auto& tested) { return test_name(all_cameras(16)[tested.param].name); });

}  // namespace
}  // namespace omma
