// omma compare: figures, limits, exit codes.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "omma/image/read.h"
#include "omma/image/write.h"
#include "tests/cli/tool.h"

namespace omma {
namespace {

class CompareCommand : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    FloatImage a({20, 20}, 3, 0.25f), b = a;
    b.values[0] = 0.5f;
    for (const char* extension : {".png", ".npy"}) {
      write_image(file(std::string("a") + extension), a, Channel::color);
      write_image(file(std::string("b") + extension), b, Channel::color);
    }
    IntImage ids({10, 10}, 1, 4);
    write_image(file("a_id.npy"), ids, Channel::id);
    for (int i = 0; i < 5; ++i) ids.values[size_t(i)] = -1;
    write_image(file("b_id.npy"), ids, Channel::id);
  }
};

TEST_F(CompareCommand, JsonHoldsEveryMetric) {
  const ToolResult result = run({"compare", "a.npy", "b.npy", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["scale"], "raw");
  EXPECT_DOUBLE_EQ(json["max"], 0.25);
  EXPECT_NEAR(json["mean"].get<double>(), 0.25 / 1200, 1e-12);
  EXPECT_NEAR(json["psnr_db"].get<double>(), 10 * std::log10(1200.0), 1e-6);
  EXPECT_GT(json["ssim"].get<double>(), 0.9);
  EXPECT_LT(json["ssim"].get<double>(), 1.0);
  EXPECT_EQ(json["id_share"], 0.0);
}

TEST_F(CompareCommand, ColourFilesAreComparedAsAScreenShowsThem) {
  const auto json = nlohmann::json::parse(run({"compare", "a.png", "b.png", "--json", "--metric", "max"}).out);
  EXPECT_EQ(json["scale"], "display");
  EXPECT_NEAR(json["max"].get<double>(), (188 - 137) / 255.0, 1e-6);  // 0.25 and 0.5 encoded
  const auto raw = nlohmann::json::parse(run({"compare", "a.png", "b.png", "--json", "--raw"}).out);
  EXPECT_NEAR(raw["max"].get<double>(), 0.25, 0.005);
}

TEST_F(CompareCommand, LimitsDecideTheExitCode) {
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max-max", "0.25", "--max-mean", "0.001"}).exit_code, 0);
  const ToolResult beyond = run({"compare", "a.npy", "b.npy", "--max-max", "0.2"});
  EXPECT_EQ(beyond.exit_code, 1);
  EXPECT_NE(beyond.err.find("max is 0.25, at most 0.2"), std::string::npos) << beyond.err;
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max-mean", "0.0001"}).exit_code, 1);
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--min-psnr", "30"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--min-psnr", "31"}).exit_code, 1);
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--min-ssim", "1"}).exit_code, 1);
  EXPECT_EQ(run({"compare", "a.npy", "a.npy", "--min-ssim", "1", "--min-psnr", "99", "--max-max", "0"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "a_id.npy", "b_id.npy", "--max-id-share", "0.05"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "a_id.npy", "b_id.npy", "--max-id-share", "0.049"}).exit_code, 1);
}

TEST_F(CompareCommand, ShiftIsMeasuredWhereItIsAskedFor) {
  FloatImage a({64, 64}, 3), b = a;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto wave = [](double u, double v) { return 0.5 + 0.2 * std::sin(0.4 * u) + 0.2 * std::cos(0.3 * v); };
      for (int c = 0; c < 3; ++c) a.at(x, y)[c] = float(wave(x, y)), b.at(x, y)[c] = float(wave(x - 0.25, y + 0.5));
    }
  }
  write_image(file("here.npy"), a, Channel::color);
  write_image(file("there.npy"), b, Channel::color);
  const auto json = nlohmann::json::parse(run({"compare", "here.npy", "there.npy", "--metric", "shift", "--json"}).out);
  EXPECT_NEAR(json["shift_xy_px"][0].get<double>(), 0.25, 0.005);
  EXPECT_NEAR(json["shift_xy_px"][1].get<double>(), -0.5, 0.005);
  EXPECT_NEAR(json["shift_px"].get<double>(), std::hypot(0.25, 0.5), 0.005);
  const std::string text = run({"compare", "here.npy", "there.npy", "--metric", "shift"}).out;
  EXPECT_NE(text.find("px to the right"), std::string::npos) << text;
  EXPECT_EQ(run({"compare", "here.npy", "there.npy"}).out.find("shift"), std::string::npos);
  EXPECT_EQ(run({"compare", "here.npy", "there.npy", "--max-shift", "0.6"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "here.npy", "there.npy", "--max-shift", "0.5"}).exit_code, 1);
  expect_refusal({"compare", "a_id.npy", "b_id.npy", "--metric", "shift"}, 2, {"shift"});
}

TEST_F(CompareCommand, DifferenceIsWrittenEvenBeyondALimit) {
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max-max", "0", "--diff", "d.npy"}).exit_code, 1);
  const FloatImage difference = std::get<FloatImage>(read_image(file("d.npy")));
  EXPECT_EQ(difference.values[0], 1.0f);
  EXPECT_EQ(difference.values[3], 0.0f);
}

TEST_F(CompareCommand, PicturesBeyondTheLimitAreRefused) {
  expect_refusal({"compare", "a.png", "b.png", "--limit", "picture_pixels=10"}, 3,
                 {"a.png", "the limit 'picture_pixels' is 10"});
  expect_refusal({"compare", "a.png", "b.png", "--limit", "picture_pixels"}, 2, {"NAME=N"});
}

TEST_F(CompareCommand, WhatCannotBeComparedIsRefused) {
  write_image(file("small.npy"), FloatImage({5, 5}, 3), Channel::color);
  write("broken.png", "no picture");
  expect_refusal({"compare", "a.npy", "missing.npy"}, 3, {"missing.npy", "no such file"});
  expect_refusal({"compare", "a.npy", "broken.png"}, 3, {"broken.png"});
  expect_refusal({"compare", "a.npy", "small.npy"}, 3, {"20 x 20", "5 x 5"});
  expect_refusal({"compare", "a.npy", "a_id.npy"}, 3, {});
  expect_refusal({"compare", "a.npy", "b.npy", "--metric", "psrn"}, 2, {"did you mean 'psnr'"});
  expect_refusal({"compare", "a_id.npy", "b_id.npy", "--metric", "ssim"}, 2, {"ssim"});
  expect_refusal({"compare", "a_id.npy", "b_id.npy", "--max-mean", "1"}, 2, {"--max-mean"});
  expect_refusal({"compare", "a.npy", "b.npy", "--max-mean", "little"}, 2, {"--max-mean"});
  expect_refusal({"compare", "a.npy", "b.npy", "--diff", "missing/d.png"}, 2, {"does not exist"});
}

}  // namespace
}  // namespace omma
