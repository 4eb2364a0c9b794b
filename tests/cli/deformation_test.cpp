// Deformed cameras and 360 degree metadata through the tool.
#include <fmt/core.h>

#include <cmath>

#include "omma/base/file.h"
#include "omma/image/pfm.h"
#include "omma/image/read.h"
#include "tests/cli/tool.h"

namespace omma {
namespace {

class DeformationCommand : public ToolTest {
 protected:
  std::string pixels(const std::string& camera, const std::string& size, const std::string& name) const {
    const ToolResult result = run({"render", "facade", "--camera", camera, "--size", size, "--samples", "1",
                                   "--technique", "raycast", "-o", name});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_file(file(name));
  }
};

TEST_F(DeformationCommand, PanoramasSayWhatPartOfTheSphereTheyShow) {
  const std::string whole = pixels("equirectangular", "64x32", "whole.jpg");
  EXPECT_NE(whole.find("GPano:FullPanoWidthPixels=\"64\""), std::string::npos);
  EXPECT_NE(whole.find("GPano:CroppedAreaLeftPixels=\"0\""), std::string::npos);
  const std::string half = pixels("vr180", "32x32", "half.png");
  EXPECT_NE(half.find("GPano:FullPanoWidthPixels=\"64\""), std::string::npos);
  EXPECT_NE(half.find("GPano:FullPanoHeightPixels=\"32\""), std::string::npos);
  EXPECT_NE(half.find("GPano:CroppedAreaLeftPixels=\"16\""), std::string::npos);
  // Beyond the poles there is no panorama, and other cameras are none.
  EXPECT_EQ(pixels("equirectangular", "64x48", "tall.jpg").find("GPano"), std::string::npos);
  EXPECT_EQ(pixels("equidistant", "64x32", "fisheye.jpg").find("GPano"), std::string::npos);
  EXPECT_NE(pixels("equirectangular", "64x32", "whole.exr").find("envmap"), std::string::npos);
  EXPECT_EQ(pixels("vr180", "32x32", "half.exr").find("envmap"), std::string::npos);
}

TEST_F(DeformationCommand, PanoramasSayWhichWayTheyLook) {
  const auto pose = [&](const std::string& camera, const std::vector<std::string>& view) {
    std::vector<std::string> words = {"render", "facade",    "--camera", camera, "--size",
                                      "32x16",  "--samples", "1",        "-o",   "pose.jpg"};
    words.insert(words.end(), view.begin(), view.end());
    const ToolResult result = run(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string bytes = read_file(file("pose.jpg"));
    std::string fields;
    for (const std::string name : {"Heading", "Pitch", "Roll"}) {
      const std::string before = "GPano:Pose" + name + "Degrees=\"";
      const size_t at = bytes.find(before) + before.size();
      fields += bytes.substr(at, bytes.find('"', at) - at) + " ";
    }
    return fields;
  };
  const std::vector<std::string> west = {"--from", "0,1,5", "--to", "-3,1,5"};
  EXPECT_EQ(pose("equirectangular", {"--from", "0,1,5", "--to", "0,1,2"}), "0 0 0 ");
  EXPECT_EQ(pose("equirectangular", west), "270 0 0 ");
  EXPECT_EQ(pose("equirectangular:yaw_deg=30,pitch_deg=-20,roll_deg=10", west), "300 -20 10 ");
  EXPECT_EQ(pose("equirectangular", {"--from", "0,1,5", "--to", "4,5,5"}), "90 45 0 ");
}

TEST_F(DeformationCommand, AFormulaDrawsWhatItsLensDraws) {
  const FloatImage formula =
      std::get<FloatImage>((pixels("expression:r=theta,fov_deg=180", "40x40", "a.npy"), read_image(file("a.npy"))));
  const FloatImage lens = std::get<FloatImage>((pixels("equidistant", "40x40", "b.npy"), read_image(file("b.npy"))));
  double difference = 0.0;
  for (size_t i = 0; i < lens.values.size(); ++i) difference += std::abs(lens.values[i] - formula.values[i]);
  EXPECT_LT(difference / static_cast<double>(lens.values.size()), 0.01);
}

TEST_F(DeformationCommand, ACameraTextureOfEachFrameIsDrawn) {
  for (int frame = 0; frame < 2; ++frame) {
    write_pfm(file(fmt::format("o_{:02}.pfm", frame)), FloatImage({2, 2}, 3, 0.25F * static_cast<float>(frame)));
  }
  const std::vector<std::string> words = {"render",      "facade",
                                          "--camera",    "camera_texture:base=perspective,file=o_%02d.pfm",
                                          "--size",      "32x32",
                                          "--samples",   "1",
                                          "--technique", "raycast",
                                          "--frames",    "2",
                                          "-o",          "f_%d.npy:distance"};
  const ToolResult result = run(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const FloatImage still = std::get<FloatImage>(read_image(file("f_0.npy")));
  const FloatImage moved = std::get<FloatImage>(read_image(file("f_1.npy")));
  size_t finite = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      const float there = *moved.at(x + 8, y + 8), here = *still.at(x, y);
      if (std::isfinite(here) && std::isfinite(there) && std::abs(here - there) < 1e-3F * here) ++finite;
    }
  }
  EXPECT_GT(finite, 200U);  // what was at a pixel is a quarter of the image farther right and down
  EXPECT_FALSE(std::isfinite(*moved.at(2, 2)));
}

TEST_F(DeformationCommand, AMissingFileOfASequenceIsFoundBeforeTheFirstFrame) {
  write_pfm(file("o_00.pfm"), FloatImage({2, 2}, 3, 0.0F));
  expect_refusal({"render", "facade", "--camera", "camera_texture:base=perspective,file=o_%02d.pfm", "--size", "32x32",
                  "--frames", "2", "-o", "f_%d.npy:distance"},
                 3, {"o_01.pfm", "no such file", "frame 1"});
}

}  // namespace
}  // namespace omma
