// Pictures lie where their camera says and look as they should, whatever the number of samples and whoever draws them.
#include <fmt/format.h>

#include <algorithm>

#include "omma/image/shift.h"
#include "omma/technique/registry.h"
#include "tests/gpu/gpu_test.h"
#include "tests/proof.h"

namespace omma {
namespace {

/// Everybody's four, and some of the others each day: powers of two, which drivers have themselves, and others.
constexpr int everyday_counts[] = {1, 2, 3, 5, 7, 8, 9, 16, 25, 64};
constexpr int most_samples = 64;

bool is_exact(const std::string& technique) {
  const std::string name = technique.substr(0, technique.find(':'));
  return std::find_if(techniques().begin(), techniques().end(),
                      [&](const TechniqueInfo& info) { return info.name == name; })
      ->exact;
}

class SamplingTest : public GpuTest, public ::testing::WithParamInterface<std::string> {
 protected:
  static int side() { return full_proof() ? 1024 : 256; }
  SamplingTest() : scene_(load_scene("city")), pose_(default_pose(scene_)) { prepare(scene_); }
  FloatImage draw_samples(const Camera& camera, const std::string& technique, int samples) {
    return draw_color(camera, pose_, {.technique = technique, .samples = samples});
  }
  /// What all exact techniques are held against; kept, for it takes longest. Those within a tolerance bend edges to one
  /// side (piecewise and subdivision by 0.02 px on the average): they are held against themselves.
  FloatImage truth(const std::string& technique) {
    if (!is_exact(technique)) return draw_samples(camera_, technique, 97);
    static const FloatImage picture = draw_samples(camera_, "visibility:cpu", full_proof() ? 1024 : 256);
    return picture;
  }

  /// A hundredth of a pixel where the picture is large enough to tell: of a small one, few samples tell its place less
  /// well. Cube maps are looked up once a pixel, whatever the samples of their faces, and vertices alone draw another
  /// picture. Observed: 0.07 px by cube maps; else 0.042 px with one sample, 0.013 px with four, 0.007 px with more.
  static double most_shift(int samples) {
    const bool is_near = GetParam().starts_with("image-based") || GetParam() == "vertex";
    return is_near ? 0.15 : full_proof() ? 0.01 : samples < 4 ? 0.08 : 0.03;
  }

  const Scene scene_;
  const glm::dmat4 pose_;
  const Camera camera_ = make_camera("equidistant:fov_deg=180", ImageSize{side(), side()});
};

TEST_P(SamplingTest, NoNumberOfSamplesMovesThePicture) {
  if (!can_draw(GetParam(), camera_)) GTEST_SKIP() << "refused";
  const std::vector<std::string> names = technique_names();
  const size_t row = size_t(std::find(names.begin(), names.end(), GetParam()) - names.begin());
  std::vector<int> counts{4};
  for (size_t i = 0; i < std::size(everyday_counts) && !full_proof(); ++i) {
    if (is_proved_today(row, i, std::size(everyday_counts))) counts.push_back(everyday_counts[i]);
  }
  for (int count = 1; count <= most_samples && full_proof(); ++count) counts.push_back(count);
  const FloatImage truth = this->truth(GetParam());
  double worst = 0.0;
  for (const int samples : counts) {
    const auto shift = image_shift(truth, draw_samples(camera_, GetParam(), samples), Scale::display);
    ASSERT_TRUE(shift);
    std::cout << fmt::format("{:2} samples: {:7.4f}, {:7.4f} px\n", samples, shift->x, shift->y);
    EXPECT_LT(glm::length(*shift), most_shift(samples)) << samples << " samples";
    worst = std::max(worst, glm::length(*shift));
  }
  RecordProperty("largest_shift_px", fmt::format("{:.4f}", worst));
}

INSTANTIATE_TEST_SUITE_P(Techniques, SamplingTest, ::testing::ValuesIn(technique_names_of_today()),
                         [](const auto& tested) { return test_name(tested.param); });

}  // namespace
}  // namespace omma
