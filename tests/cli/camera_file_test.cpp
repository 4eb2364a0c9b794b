// omma camera on calibration files: converting, and what it says when it cannot.
#include <nlohmann/json.hpp>

#include "omma/base/file.h"
#include "tests/cli/tool.h"
#include "tests/unit/camera_files_samples.h"

namespace omma {
namespace {

class CameraFileCommand : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    for (const SampleFile& sample : sample_files()) {
      if (std::string(sample.format) == "kalibr") write("rig.yaml", sample.text);
    }
  }
};

TEST_F(CameraFileCommand, WritesTheCameraInAnotherFormatAndReadsItAgain) {
  ASSERT_EQ(run({"camera", "rig.yaml#cam1", "-o", "basalt.json", "--format", "basalt"}).exit_code, 0);
  const ToolResult before = run({"camera", "rig.yaml#cam1", "--json"}),
                   after = run({"camera", "basalt.json", "--json"});
  ASSERT_EQ(after.exit_code, 0) << after.err;
  EXPECT_EQ(before.out, after.out);
}

TEST_F(CameraFileCommand, ConvertsToAnotherModelAndSaysHowFarItIsOff) {
  const ToolResult result = run({"camera", "rig.yaml#cam1", "--model", "kb4", "-o", "cameras.txt", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto residual = nlohmann::json::parse(result.out)["residual"];
  EXPECT_GT(residual["points"].get<int>(), 1000);
  EXPECT_LT(residual["mean_px"].get<double>(), 0.5);
  EXPECT_LE(residual["p95_px"].get<double>(), residual["max_px"].get<double>());
  EXPECT_NE(read_file(file("cameras.txt")).find("OPENCV_FISHEYE 512 512"), std::string::npos);
}

TEST_F(CameraFileCommand, RefusesWhatLeavesAChoiceOrHasNoPlace) {
  expect_refusal({"camera", "rig.yaml"}, 2, {"rig.yaml#cam0", "cam1"});
  expect_refusal({"camera", "rig.yaml#cam1", "-o", "out.yaml"}, 2, {"--format", "kalibr", "opencv"});
  expect_refusal({"camera", "rig.yaml#cam1", "-o", "out.yaml", "--format", "ros"}, 2, {"double_sphere", "--model"});
  expect_refusal({"camera", "rig.yaml#cam1", "-o", "out.yaml", "--format", "kalbr"}, 2, {"kalibr"});
  expect_refusal({"camera", "rig.yaml#cam1", "--model", "double_spere"}, 2, {"double_sphere"});
  expect_refusal({"camera", "rig.yaml#cam1", "--format", "kalibr"}, 2, {"-o"});
  write("broken.yaml", "cam0:\n  camera_model: pinhole\n");
  expect_refusal({"camera", "broken.yaml"}, 3, {"broken.yaml", "cam0", "distortion_model"});
}

/// A value takes sixty times as much memory as its text.
TEST_F(CameraFileCommand, MillionsOfValuesAreRefused) {
  std::string text = "[1";
  for (int i = 0; i < 1000; ++i) text += ",1";
  write("ones.json", text);
  expect_refusal({"camera", "ones.json", "--limit", "document_values=1000"}, 3,
                 {"ones.json:1:", "more than 1000 values", "--limit document_values=N"});
}

}  // namespace
}  // namespace omma
