// What the processor draws by each of its instruction sets; unit tests run with sanitizers, which have few of them.
#include <gtest/gtest.h>

#include <cmath>

#include "omma/math/pose.h"
#include "omma/software/software_renderer.h"
#include "omma/visibility/find_blocks.h"

namespace omma {
namespace {

class SimdTargetsTest : public ::testing::Test {
 protected:
  void TearDown() override { use_simd_target(""); }
};

TEST_F(SimdTargetsTest, DrawTheSamePicture) {
  const Scene scene = load_scene("room");
  const LazySceneIndex index(scene);
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  constexpr Channel color[] = {Channel::color};
  const auto draw = [&](const Camera& camera) {
    const auto pictures = SoftwareRenderer(index).render(camera, pose, color,
                                                         {.samples = 2, .shadows = Shadows::cube, .shadow_size = 64});
    return std::get<FloatImage>(pictures.at(Channel::color));
  };
  for (const char* text : {"equidistant:fov_deg=180", "cylinder:fov_deg=360"}) {
    const Camera camera = make_camera(text, ImageSize{96, 72});
    const FloatImage best = draw(camera);
    for (const std::string& target : simd_targets()) {
      use_simd_target(target);
      const FloatImage other = draw(camera);
      double sum = 0.0, light = 0.0;
      for (size_t i = 0; i < other.values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(other.values[i])) << target;
        sum += std::abs(other.values[i] - best.values[i]);
        light += best.values[i];
      }
      EXPECT_GT(light, 0.0);
      // Observed: 1e-6. A ray that one rounding sends past an edge sees something else altogether.
      EXPECT_LT(sum / double(other.values.size()), 1e-4) << target << ", " << text;
    }
    use_simd_target("");
  }
}

}  // namespace
}  // namespace omma
