// What this machine cannot do is said as such: exit code 4, and nothing half-written is left.
#include "omma/base/file.h"
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
  expect_refusal({"doctor"}, 4, {"EGL", "visibility:cpu draw everything but"}, no_gl);
}

TEST_F(Machine, WhatNeedsGlIsRefusedWithWhatWorks) {
  expect_refusal(with(small_render, {"-o", "a.png", "--technique", "raycast"}), 4,
                 {"EGL", "auto and visibility:cpu draw everything but --show pieces and overdraw"}, no_gl);
  expect_refusal(with(small_render, {"-o", "a.npy:id", "--technique", "raycast"}), 4, {"EGL", "auto"}, no_gl);
}

TEST_F(Machine, EveryChannelCanDoWithoutGl) {
  const std::vector<std::string> wanted{"-o", "a/c.npy:color",  "-o", "a/d.npy:distance", "-o", "a/z.npy:z",
                                        "-o", "a/n.npy:normal", "-o", "a/p.npy:position", "-o", "a/uv.npy:uv",
                                        "-o", "a/id.npy:id",    "-o", "a/o.npy:object",   "-o", "a/m.npy:material"};
  const auto into = [&](const std::string& folder, const std::string& technique) {
    std::filesystem::create_directory(file(folder));
    std::vector<std::string> words = with(small_render, {"--technique", technique, "--shadows", "paraboloid",
                                                         "--reflect", "0", "--effect", "checker", "--show", "edges"});
    for (const std::string& word : wanted) words.push_back(word[0] == 'a' ? folder + word.substr(1) : word);
    return words;
  };
  const ToolResult result = run(into("a", "auto"), no_gl);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("visibility:cpu on the processor"), std::string::npos) << result.err;
  ASSERT_EQ(run(into("b", "visibility"), no_gl).exit_code, 0);
  ASSERT_EQ(run(into("c", "auto")).exit_code, 0);
  for (const char* name : {"c.npy", "d.npy", "z.npy", "n.npy", "p.npy", "uv.npy", "id.npy", "o.npy", "m.npy"}) {
    for (const char* other : {"b/", "c/"}) {
      EXPECT_TRUE(read_file(file(std::string("a/") + name)) == read_file(file(std::string(other) + name)))
          << other << name;
    }
  }
  // Flat cameras, ray maps and sequences, too.
  ASSERT_EQ(run({"camera", "perspective:fov_deg=80", "--size", "64x48", "--rays", "rays.npy"}, no_gl).exit_code, 0);
  for (const char* camera : {"perspective:fov_deg=80", "rays.npy"}) {
    EXPECT_EQ(run({"render", "room", "--camera", camera, "-o", "e.npy:id"}, no_gl).exit_code, 0) << camera;
  }
  EXPECT_EQ(run(with(small_render, {"--frames", "2", "-o", "f_%d.npy:id"}), no_gl).exit_code, 0);
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
