// A mesh whose vertices move with every frame is drawn as if it had just been loaded, whatever a technique keeps.
#include <cmath>
#include <optional>

#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"

namespace omma {
namespace {

/// Dents the ball, another way in every frame, and lets it grow.
void dent(Mesh& ball, const std::vector<glm::vec3>& at_rest, int frame) {
  for (size_t i = 0; i < ball.positions.size(); ++i) {
    const glm::vec3& rest = at_rest[i];
    const float wave = std::sin(5.0f * rest.x + float(frame)) * std::cos(4.0f * rest.y - 2.0f * float(frame));
    ball.positions[i] = rest * (1.0f + 0.3f * float(frame) + 0.3f * wave);
  }
}

class DeformingMeshTest : public GpuTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(DeformingMeshTest, IsDrawnAsIfJustLoaded) {
  Scene scene = make_ball_and_pane();
  Mesh& ball = scene.meshes[size_t(scene.instances[0].mesh)];
  const std::vector<glm::vec3> at_rest = ball.positions;
  prepare(scene);
  const Camera camera = make_camera("equidistant:fov_deg=180,width=128,height=96");
  const Channel wanted[] = {Channel::id};
  std::optional<IntImage> before;
  for (int frame = 0; frame < 4; ++frame) {
    dent(ball, at_rest, frame);
    follow(scene);
    const IntImage ids = draw_ids(camera, glm::dmat4(1.0), GetParam());
    const PreparedScene fresh(device(), scene);
    const auto picture = fresh.render(camera, glm::dmat4(1.0), wanted, {.technique = GetParam()});
    EXPECT_EQ(share_of_differences(ids, std::get<IntImage>(picture.at(Channel::id))), 0.0) << frame;
    // The tolerance of those that have one, and what drivers round vertices by.
    const Verdict verdict = judge(Oracle(scene, glm::dmat4(1.0)), camera, ids, {.radius = 0.25 + 1.0 / 128.0});
    EXPECT_EQ(verdict.wrong, 0u) << frame << ": " << verdict.first_wrong;
    if (before) {
      EXPECT_GT(share_of_differences(ids, *before), 0.01) << frame;
    }
    before = ids;
  }
}

/// All that are right to within a tolerance.
std::vector<std::string> tested_techniques() {
  std::vector<std::string> names = distinct_technique_names();
  std::erase_if(names, [](const std::string& name) {
    return name == "planar" || name == "vertex" || name.starts_with("image-based");
  });
  names.push_back("visibility:gpu");
  return names;
}

INSTANTIATE_TEST_SUITE_P(Techniques, DeformingMeshTest, ::testing::ValuesIn(tested_techniques()),
                         [](const auto& tested) { return test_name(tested.param); });

}  // namespace
}  // namespace omma
