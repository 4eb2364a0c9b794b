// Pictures lie where their camera says and look as they should, whatever the number of samples and whoever draws them.
#include <fmt/format.h>

#include "omma/image/shift.h"
#include "omma/technique/registry.h"
#include "tests/gpu/gpu_test.h"
#include "tests/proof.h"

namespace omma {
namespace {

constexpr int most_samples = 64;

class SamplingTest : public GpuTest, public ::testing::WithParamInterface<std::string> {
 protected:
  SamplingTest() : scene_(load_scene("city")), pose_(default_pose(scene_)) { renderer().load(scene_); }
  FloatImage draw_samples(const Camera& camera, const std::string& technique, int samples) {
    return draw_color(camera, pose_, {.technique = technique, .samples = samples});
  }
  /// By a way of drawing that all techniques are held against; kept, for it takes longest.
  const FloatImage& truth() {
    static const FloatImage picture = draw_samples(camera_, "visibility:cpu", 1024);
    return picture;
  }

  const Scene scene_;
  const glm::dmat4 pose_;
  const Camera camera_ = make_camera("equidistant:fov_deg=180", ImageSize{512, 512});
};

TEST_P(SamplingTest, NoNumberOfSamplesMovesThePicture) {
  if (!can_draw(GetParam(), camera_)) GTEST_SKIP() << "refused";
  const std::vector<std::string> techniques = technique_names();
  const size_t row = size_t(std::find(techniques.begin(), techniques.end(), GetParam()) - techniques.begin());
  double worst = 0.0;
  for (int samples = 1; samples <= most_samples; ++samples) {
    // What everybody asks for, every day.
    if (samples != 4 && !is_proved_today(row, size_t(samples), size_t(most_samples))) continue;
    const auto shift = image_shift(truth(), draw_samples(camera_, GetParam(), samples), Scale::display);
    ASSERT_TRUE(shift);
    std::cout << fmt::format("{:2} samples: {:7.4f}, {:7.4f} px\n", samples, shift->x, shift->y);
    EXPECT_LT(glm::length(*shift), 0.01) << samples << " samples";
    worst = std::max(worst, glm::length(*shift));
  }
  RecordProperty("largest_shift_px", fmt::format("{:.4f}", worst));
}

INSTANTIATE_TEST_SUITE_P(Techniques, SamplingTest, ::testing::ValuesIn(technique_names()),
                         [](const auto& tested) { return test_name(tested.param); });

}  // namespace
}  // namespace omma
