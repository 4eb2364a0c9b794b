// omma camera, and camera files that are broken.
#include <nlohmann/json.hpp>

#include "omma/base/file.h"
#include "tests/cli/tool.h"

namespace omma {
namespace {

using CameraCommand = ToolTest;

TEST_F(CameraCommand, JsonHoldsWhatWasAsked) {
  const ToolResult result = run({"camera", "equidistant:fov_deg=180", "--size", "200x100", "--project", "0,0,-1",
                                 "--project", "-1,0,0", "--unproject", "150,50", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["width"], 200);
  EXPECT_EQ(json["height"], 100);
  EXPECT_EQ(json["model"], "equidistant");
  EXPECT_NEAR(json["project"][0]["pixel"][0].get<double>(), 100.0, 1e-9);
  EXPECT_NEAR(json["project"][0]["pixel"][1].get<double>(), 50.0, 1e-9);
  // The default circle spans the height: 90 degrees to the left are 50 pixels.
  EXPECT_NEAR(json["project"][1]["pixel"][0].get<double>(), 50.0, 1e-6);
  EXPECT_NEAR(json["unproject"][0]["direction"][0].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(json["vertical_fov_deg"].get<double>(), 180.0, 0.1);
}

TEST_F(CameraCommand, CanonicalTextMakesTheSameCamera) {
  const auto first = nlohmann::json::parse(run({"camera", "equisolid:fov_deg=200", "--json"}).out);
  const auto second = nlohmann::json::parse(run({"camera", first["camera"], "--json"}).out);
  EXPECT_EQ(first, second);
}

TEST_F(CameraCommand, RaysAreARayMap) {
  ASSERT_EQ(run({"camera", "equidistant:fov_deg=180", "--size", "20x20", "--rays", "rays.npy"}).exit_code, 0);
  const ToolResult result = run({"camera", "rays.npy", "--unproject", "10,10", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto direction = nlohmann::json::parse(result.out)["unproject"][0]["direction"];
  EXPECT_NEAR(direction[2].get<double>(), -1.0, 1e-3);
  expect_refusal({"camera", "rays.npy", "--project", "0,0,-1"}, 2, {"ray map"});
  expect_refusal({"camera", "rays.npy", "--size", "10x10"}, 2, {"20 x 20"});
}

TEST_F(CameraCommand, WrongValuesAreRefused) {
  expect_refusal({"camera", "equidistant", "--project", "0,0,0"}, 2, {"--project"});
  expect_refusal({"camera", "equidistant", "--project", "0,0"}, 2, {"--project"});
  expect_refusal({"camera", "equidistant", "--unproject", "1,2,3"}, 2, {"--unproject"});
  expect_refusal({"camera", "equidistant", "--rays", "rays.png"}, 2, {".npy"});
}

TEST_F(CameraCommand, PiecesAreACamera) {
  const ToolResult made =
      run({"camera", "cylinder", "--size", "320x200", "--pieces", "p.json", "--count", "16", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto json = nlohmann::json::parse(made.out)["pieces"];
  EXPECT_EQ(json["count"], 16);
  EXPECT_EQ(json["layout"], "strips");
  EXPECT_GT(json["max_px"].get<double>(), 0.25);
  const ToolResult again = run({"camera", "p.json", "--project", "1,0,0", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto camera = nlohmann::json::parse(again.out);
  EXPECT_EQ(camera["model"], "pieces");
  EXPECT_EQ(camera["piece_count"], 16);
  EXPECT_NEAR(camera["project"][0]["pixel"][0].get<double>(), 240.0, 0.1);
  const ToolResult within =
      run({"camera", "cylinder", "--size", "320x200", "--pieces", "q.json", "--tolerance", "0.1", "--json"});
  ASSERT_EQ(within.exit_code, 0) << within.err;
  EXPECT_LT(nlohmann::json::parse(within.out)["pieces"]["max_px"].get<double>(), 0.11);
  expect_refusal({"camera", "p.json", "--size", "10x10"}, 2, {"320 x 200"});
  expect_refusal({"camera", "cylinder", "--pieces", "p.npy"}, 2, {".json"});
  expect_refusal({"camera", "cylinder", "--count", "9"}, 2, {"--pieces"});
  expect_refusal({"camera", "cylinder", "--pieces", "p.json", "--count", "0"}, 2, {"--count"});
  expect_refusal({"camera", "cylinder", "--pieces", "p.json", "--tolerance", "0"}, 2, {"0.01"});
  expect_refusal({"camera", "cylinder", "--pieces", "p.json", "--tolerance", "1", "--count", "9"}, 2, {"--count"});
}

TEST_F(CameraCommand, BrokenRayMapsAreRefused) {
  ASSERT_EQ(run({"camera", "equidistant", "--size", "20x20", "--rays", "rays.npy"}).exit_code, 0);
  const std::string bytes = read_file(file("rays.npy"));
  for (const size_t length : {size_t{0}, size_t{5}, size_t{60}, bytes.size() / 2, bytes.size() - 1}) {
    write("broken.npy", bytes.substr(0, length));
    expect_refusal({"camera", "broken.npy"}, 3, {"broken.npy"});
    expect_refusal({"render", "facade", "--camera", "broken.npy", "-o", "a.png"}, 3, {"broken.npy"});
  }
  expect_refusal({"camera", "missing.npy"}, 3, {"missing.npy", "no such file"});
}

}  // namespace
}  // namespace omma
