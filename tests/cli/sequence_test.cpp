// Sequences: numbered files, and a run that was cut off goes on with the first missing frame.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "omma/base/file.h"
#include "omma/image/read.h"
#include "tests/cli/tool.h"
#include "tests/places.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

class Sequence : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    std::string poses;
    for (int i = 0; i < frame_count; ++i) poses += fmt::format("{} {} 3 20 1 0 0 0\n", i, i);
    write("poses.txt", poses);
  }

  static constexpr int frame_count = 6;
  const std::vector<std::string> command_{
      "render",  "facade",    "--camera",  "equidistant", "--size",     "32x24", "--samples",
      "1",       "--pose",    "poses.txt", "-o",          "f_%03d.npy", "-o",    "d_%03d.exr:distance",
      "--stats", "stats.json"};
  nlohmann::json stats() const { return nlohmann::json::parse(read_file(file("stats.json"))); }
};

TEST_F(Sequence, EveryPoseIsAPicture) {
  const ToolResult result = run(command_);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(files().size(), size_t(2 * frame_count + 2));  // and the poses and stats
  EXPECT_TRUE(fs::exists(file("f_005.npy")));
  EXPECT_NE(result.err.find("6 of 6 frames"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("frames/s"), std::string::npos);
  EXPECT_EQ(result.err.find('\r'), std::string::npos) << "a bar is for terminals";
  EXPECT_EQ(stats()["frames"].size(), size_t(frame_count));
  EXPECT_EQ(run({"compare", "f_000.npy", "f_005.npy", "--max-mean", "0.001"}).exit_code, 1);
}

TEST_F(Sequence, OnlyMissingFramesAreRendered) {
  ASSERT_EQ(run(command_).exit_code, 0);
  const auto untouched = fs::last_write_time(file("f_001.npy"));
  const std::string frame2 = read_file(file("f_002.npy"));
  fs::remove(file("f_002.npy"));
  fs::remove(file("d_004.exr"));
  const ToolResult again = run(command_);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(fs::last_write_time(file("f_001.npy")), untouched);
  EXPECT_EQ(read_file(file("f_002.npy")), frame2);
  EXPECT_TRUE(fs::exists(file("d_004.exr")));
  EXPECT_EQ(stats()["frames_skipped"], frame_count - 2);
  EXPECT_EQ(stats()["frames"].size(), 2u);
  EXPECT_EQ(stats()["frames"][0]["frame"], 2);

  const ToolResult nothing = run(command_);
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_NE(nothing.err.find("there already"), std::string::npos);
  std::vector<std::string> overwrite = command_;
  overwrite.emplace_back("--overwrite");
  ASSERT_EQ(run(overwrite).exit_code, 0);
  EXPECT_EQ(stats()["frames"].size(), size_t(frame_count));
  EXPECT_NE(fs::last_write_time(file("f_001.npy")), untouched);
}

TEST_F(Sequence, KilledRunLeavesOnlyWholeFilesAndGoesOn) {
  std::string poses;
  for (int i = 0; i < 400; ++i) poses += fmt::format("{} {} 3 20 1 0 0 0\n", i, 0.01 * i);
  write("poses.txt", poses);
  ToolLimits limits;
  // Wherever the kill falls, before the first frame or among them, the rest must hold.
  for (const int milliseconds : {300, 900}) {
    limits.kill_after_ms = milliseconds;
    run(command_, limits);
    for (const std::string& name : files()) {
      if (name.starts_with("f_") || name.starts_with("d_")) {
        EXPECT_NO_THROW(read_image(file(name))) << name;
      }
    }
  }
  write("poses.txt", poses.substr(0, poses.find("\n12 ") + 1));  // enough to see that it goes on
  ASSERT_EQ(run(command_).exit_code, 0);
  for (const std::string& name : files()) EXPECT_FALSE(name.starts_with(".")) << name << " was left behind";
  EXPECT_TRUE(fs::exists(file("f_011.npy")));
}

/// Frames are written while the next ones are drawn, and what becomes of them is said all the same.
TEST_F(Sequence, FrameThatCannotBeWrittenEndsTheRun) {
  ToolLimits full;
  full.file_bytes = 1000;
  expect_refusal({"render", "facade", "--camera", "equidistant", "--size", "32x24", "--samples", "1", "--frames", "4",
                  "-o", "f_%d.npy"},
                 4, {"f_0.npy", "cannot be written"}, full);
}

TEST_F(Sequence, FramesBeforeOneThatCannotBeDrawnAreWritten) {
  std::string offsets = "PF\n4 4\n-1.0\n" + std::string(4 * 4 * 3 * 4, '\0');
  write("o_0.pfm", offsets);
  write("o_1.pfm", offsets);
  write("o_2.pfm", "broken");
  const ToolResult result = run({"render", "facade", "--camera", "camera_texture:file=o_%d.pfm,base=equidistant",
                                 "--size", "32x24", "--samples", "1", "--frames", "3", "-o", "f_%d.npy"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("o_2.pfm"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(file("f_0.npy")) && fs::exists(file("f_1.npy")));
  EXPECT_FALSE(fs::exists(file("f_2.npy")));
}

TEST_F(Sequence, FramesRunOverTheAnimationsTime) {
  const fs::path scene = fs::path(places::test_models) / "Collada/box_nested_animation.dae";
  if (!fs::exists(scene)) GTEST_SKIP() << "assimp-testmodels is not installed: " << scene;
  const std::vector<std::string> words{
      "render", scene.string(), "--camera", "equidistant", "--size", "48x48", "--samples",
      "1",      "--frames",     "3",        "--fps",       "4",      "-o",    "a_%d.npy:distance"};
  const ToolResult result = run(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::exists(file("a_0.npy")) && fs::exists(file("a_1.npy")) && fs::exists(file("a_2.npy")));
  EXPECT_EQ(run({"compare", "a_0.npy", "a_2.npy", "--max-max", "0"}).exit_code, 1);

  // A frame of a sequence is the picture of its time.
  ASSERT_EQ(run({"render", scene.string(), "--camera", "equidistant", "--size", "48x48", "--samples", "1", "--time",
                 "0.5", "-o", "b.npy:distance"})
                .exit_code,
            0);
  EXPECT_EQ(run({"compare", "a_2.npy", "b.npy", "--max-max", "0"}).exit_code, 0);
}

}  // namespace
}  // namespace omma
