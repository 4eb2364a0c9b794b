// Calibration files of simulators: what USD's lens attributes and SDFormat's distortion mean.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/camera_files_expect.h"

namespace omma {
namespace {

TEST(CameraFiles, UsdTakesTheFocalLengthOfKannalaBrandtAndThinPrismFromTheCamera) {
  // 2 of 8 millimetres for 1600 pixels, 2 of 5 for 1200; k0 is the coefficient of θ³.
  const Lens left = lens_of(sample("usd", 1), "left");
  expect_lens(left, "opencv_fisheye", {1600, 1200}, {400, 480, 801.5, 598.25}, {0.05, 0.01, -0.003, -0.0005});
  EXPECT_DOUBLE_EQ(left.parameters.max_angle, 85.0 * 3.14159265358979323846 / 180.0);
  const auto seen = left.project({std::sin(0.5), 0, -std::cos(0.5)});
  ASSERT_TRUE(seen);
  // 0.5 + 0.05/8 + 0.01/32 - 0.003/128 - 0.0005/512, times 400
  EXPECT_NEAR(seen->x, 801.5 + 400 * (0.5 + 0.00625 + 0.0003125 - 0.0000234375 - 0.0000009765625), 1e-9);
  EXPECT_NEAR(seen->y, 598.25, 1e-9);

  // Square pixels without a verticalAperture: 1.5 of 3.5 for 1400.
  const Lens right = lens_of(sample("usd", 1), "right");
  expect_lens(right, "fisheye624", {1400, 1408}, {600, 600, 714.5, 704},
              {0.4, -0.48, 0.11, 0.09, -0.05, 0.0073, -0.0005, 0.0003, 0.0006, -0.00022, 0.0004, -0.00014});
  // Project Aria's formula, 0.5 radians below the axis: r before p and s; p0 goes with 2 x y on y, p1 with r² + 2 y².
  const double r = 0.5 * (1 + 0.4 / 4 - 0.48 / 16 + 0.11 / 64 + 0.09 / 256 - 0.05 / 1024 + 0.0073 / 4096), r2 = r * r;
  const auto below = right.project({0, -std::sin(0.5), -std::cos(0.5)});
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->x, 714.5 + 600 * (-0.0005 * r2 + 0.0006 * r2 - 0.00022 * r2 * r2), 1e-9);
  EXPECT_NEAR(below->y, 704 + 600 * (r + 0.0003 * 3 * r2 + 0.0004 * r2 - 0.00014 * r2 * r2), 1e-9);
}

TEST(CameraFiles, UsdKannalaBrandtWithoutAFocalLengthIsInPixelsAsNewtonReadsIt) {
  const std::string without =
      replaced(sample("usd", 1), R"("focalLength": 2, "horizontalAperture": 8, "verticalAperture": 5,)", "");
  std::string text = replaced(without, R"(K3:k0": 0.05)", R"(K3:k0": 500)");
  text = replaced(text, R"(K3:k1": 0.01)", R"(K3:k1": -20)");
  const Lens lens = lens_of(text, "left");
  const auto seen = lens.project({std::sin(0.5), 0, -std::cos(0.5)});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 801.5 + 500 * 0.5 - 20 * 0.125 - 0.003 / 32 - 0.0005 / 128, 1e-9);
  expect_input_error(without, {"left", "focalLength", "pixels per radian"});
  expect_input_error(replaced(sample("usd", 1), R"(K3:k0": 0.05)", R"(K3:k0": 500)"), {":4", "k0", "focalLength"});
}

TEST(CameraFiles, WhatUsdLeavesAwayOrHasInTexturesIsRefused) {
  expect_input_error(replaced(sample("usd", 1), R"("omni:lensdistortion:radTanThinPrism:s2": 0.0004, )", ""),
                     {"radTanThinPrism:s2", "missing"});
  expect_input_error(replaced(sample("usd", 1), R"("horizontalAperture": 3.5)", R"("horizontalAperture": 0)"),
                     {":7", "right.horizontalAperture", "positive"});
  expect_input_error(R"({"omni:lensdistortion:model": "lut"})", {"omni:lensdistortion:model", "lut", "textures"});
}

TEST(CameraFiles, SdfDistortsAPinholeAsOpenCv) {
  const std::string text = sample("sdf", 1);
  // Half of the field, 30 degrees, lies at the edge of the picture before it is distorted: f = 320 √3.
  const double f = 320 / std::tan(0.5 * 1.0471975512);
  const Lens lens = lens_of(text);
  expect_lens(lens, "opencv", {640, 480}, {f, f, 320, 240}, {-0.25, 0.12, 0.001, -0.002, -0.03, 0});
  // The point (0.4, 0.2) of the plane z = 1, r² = 0.2, by gz-rendering's formula.
  const auto seen = lens.project(glm::normalize(glm::dvec3(0.4, -0.2, -1)));
  ASSERT_TRUE(seen);
  const double radial = 1 - 0.25 * 0.2 + 0.12 * 0.04 - 0.03 * 0.008;
  EXPECT_NEAR(seen->x, 320 + f * (0.4 * radial - 0.002 * (0.2 + 2 * 0.16) + 2 * 0.001 * 0.08), 1e-9);
  EXPECT_NEAR(seen->y, 240 + f * (0.2 * radial + 0.001 * (0.2 + 2 * 0.04) + 2 * -0.002 * 0.08), 1e-9);

  const std::string aside = replaced(text, "0.5 0.5", "0.525 0.45");
  expect_lens(lens_of(aside), "opencv", {640, 480}, {f, f, 336, 216}, {-0.25});
  const std::string intrinsics =
      "<lens><intrinsics><fx>500</fx><fy>510</fy><cx>336</cx><cy>216</cy><s>0</s></intrinsics></lens></camera>";
  expect_lens(lens_of(replaced(aside, "</camera>", intrinsics)), "opencv", {640, 480}, {500, 510, 336, 216},
              {-0.25, 0.12});
  expect_input_error(replaced(text, "</camera>", intrinsics), {":4", "distortion.center", "intrinsics"});
  expect_input_error(replaced(text, "0.5 0.5", "0.5"), {"distortion.center", "2 are expected"});
  expect_input_error(replaced(text, "<k1>", "<ignition:legacy_mode>true</ignition:legacy_mode><k1>"), {"legacy_mode"});
  expect_input_error(replaced(text, "</camera>", "<lens><type>equidistant</type></lens></camera>"),
                     {"distortion", "gnomonical"});
  const std::string none = "<distortion><k1>0</k1></distortion><lens>";
  EXPECT_STREQ(lens_of(replaced(sample("sdf"), "<lens>", none)).model->info.name, "custom_radial");
}

}  // namespace
}  // namespace omma
