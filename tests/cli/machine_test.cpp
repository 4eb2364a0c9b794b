// What this machine cannot do is said as such: exit code 4, and nothing half-written is left.
#include "tests/cli/tool.h"

namespace omma {
namespace {

using Machine = ToolTest;

/// libglvnd finds no driver then.
const ToolLimits no_gl{{{"__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null"}}};
const std::vector<std::string> small_render{"render", "facade",  "--camera",  "equidistant",
                                            "--size", "128x128", "--samples", "1"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Machine, NoUsableGlIsSaid) {
  expect_refusal(with(small_render, {"-o", "a.png"}), 4, {"EGL"}, no_gl);
  expect_refusal({"doctor"}, 4, {"EGL"}, no_gl);
}

TEST_F(Machine, WhatNeedsNoGlWorksWithout) {
  EXPECT_EQ(run({"cameras"}, no_gl).exit_code, 0);
  EXPECT_EQ(run({"techniques"}, no_gl).exit_code, 0);
  EXPECT_EQ(run({"camera", "equidistant"}, no_gl).exit_code, 0);
}

TEST_F(Machine, FullDiskLeavesNothing) {
  ToolLimits full;
  full.file_bytes = 1000;
  full.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}};
  for (const char* output : {"a.png", "a.jpg", "a.exr", "a.pfm", "a.npy"}) {
    expect_refusal(with(small_render, {"-o", output}), 4, {output, "cannot be written"}, full);
  }
  expect_refusal({"camera", "equidistant", "--rays", "rays.npy"}, 4, {"rays.npy", "cannot be written"}, full);
}

TEST_F(Machine, DoctorTriesEveryTechnique) {
  const ToolResult result = run({"doctor"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  for (const char* expected : {"CPU", "taken: ", "texture side", "raycast", "image-based"}) {
    EXPECT_NE(result.out.find(expected), std::string::npos) << expected;
  }
  EXPECT_EQ(result.out.find("does not work"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace omma
