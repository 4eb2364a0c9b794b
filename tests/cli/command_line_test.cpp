// What is wrong with a command is said before anything is loaded or drawn, with the name that was meant: exit code 2.
#include "tests/cli/tool.h"

namespace omma {
namespace {

using CommandLine = ToolTest;

const std::vector<std::string> commands{"render", "compare",    "camera",  "cameras", "scenes",
                                        "doctor", "techniques", "effects", "bench"};

/// A command that would render, and what follows.
std::vector<std::string> render(const std::vector<std::string>& more) {
  std::vector<std::string> words{"render", "facade", "--camera", "equidistant:fov_deg=180"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(CommandLine, EveryCommandHasHelpWithAnExample) {
  const ToolResult overview = run({"--help"});
  EXPECT_EQ(overview.exit_code, 0);
  for (const std::string& command : commands) {
    EXPECT_NE(overview.out.find(command), std::string::npos);
    const ToolResult help = run({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_TRUE(help.err.empty());
    EXPECT_NE(help.out.find("\n  omma " + command), std::string::npos) << command;
    EXPECT_GT(help.out.size(), 200u) << command;
  }
}

TEST_F(CommandLine, VersionIsPrinted) {
  const ToolResult result = run({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.substr(0, 5), "omma ");
}

TEST_F(CommandLine, ListsSayWhatThereIs) {
  EXPECT_NE(run({"cameras"}).out.find("equidistant"), std::string::npos);
  EXPECT_NE(run({"cameras", "--markdown"}).out.find("| "), std::string::npos);
  EXPECT_NE(run({"scenes"}).out.find("city"), std::string::npos);
  EXPECT_NE(run({"effects"}).out.find("width_px"), std::string::npos);
  EXPECT_NE(run({"effects", "--markdown"}).out.find("| `width_px` |"), std::string::npos);
  EXPECT_NE(run({"techniques"}).out.find("raycast"), std::string::npos);
}

TEST_F(CommandLine, NothingAndUnknownCommandsAreRefused) {
  expect_refusal({}, 2, {"omma", "render"});
  expect_refusal({"rendr"}, 2, {"unknown command 'rendr'", "did you mean 'render'"});
  expect_refusal({"--hlep"}, 2, {"unknown option '--hlep'", "did you mean '--help'"});
}

TEST_F(CommandLine, UnknownNamesAreRefusedWithTheNearest) {
  expect_refusal(render({"--camra", "x", "-o", "a.png"}), 2, {"unknown option '--camra'", "'--camera'"});
  expect_refusal(render({"-q", "-o", "a.png"}), 2, {"unknown option '-q'"});
  expect_refusal({"render", "facade", "--camera", "equidistnat", "-o", "a.png"}, 2,
                 {"unknown camera 'equidistnat'", "did you mean 'equidistant'"});
  expect_refusal({"render", "facade", "--camera", "equidistant:fov_dge=180", "-o", "a.png"}, 2,
                 {"'fov_dge'", "did you mean 'fov_deg'"});
  expect_refusal(render({"--technique", "raycats", "-o", "a.png"}), 2, {"'raycats'", "did you mean 'raycast'"});
  expect_refusal(render({"--technique", "image-based:layerd", "-o", "a.png"}), 2, {"'layerd'", "'layered'"});
  expect_refusal(render({"-o", "a.exr:distnace"}), 2, {"unknown channel 'distnace'", "did you mean 'distance'"});
  expect_refusal(render({"--effect", "wirefrme", "-o", "a.png"}), 2, {"'wirefrme'", "did you mean 'wireframe'"});
  expect_refusal(render({"--effect", "wireframe:color=blck", "-o", "a.png"}), 2, {"color", "did you mean 'black'"});
  expect_refusal(render({"--show", "edgse", "-o", "a.png"}), 2, {"'edgse'", "did you mean 'edges'"});
  expect_refusal(render({"--filter", "anisotropc", "-o", "a.png"}), 2, {"did you mean 'anisotropic'"});
  expect_refusal({"render", "facde", "--camera", "equidistant", "-o", "a.png"}, 2, {"'facde'", "'facade'"});
  expect_refusal({"render", "facade:colums=3", "--camera", "equidistant", "-o", "a.png"}, 2, {"'colums'"});
}

TEST_F(CommandLine, TechniquesThatCannotDrawTheCameraAreRefused) {
  ASSERT_EQ(run({"camera", "equidistant", "--size", "16x16", "--rays", "rays.npy"}).exit_code, 0);
  expect_refusal({"render", "facade", "--camera", "rays.npy", "--technique", "vertex", "-o", "a.png"}, 2,
                 {"vertex", "ray map"});
  expect_refusal(render({"--technique", "planar", "-o", "a.png"}), 2, {"planar", "perspective"});
}

TEST_F(CommandLine, MissingAndSurplusWordsAreRefused) {
  expect_refusal({"render"}, 2, {"required"});
  expect_refusal({"render", "facade", "-o", "a.png"}, 2, {"--camera"});
  expect_refusal(render({}), 2, {"--output"});
  expect_refusal(render({"surplus", "-o", "a.png"}), 2, {"surplus"});
  expect_refusal(render({"-o", "a.png", "--size"}), 2, {"--size"});
  expect_refusal({"compare", "a.png"}, 2, {"required"});
}

TEST_F(CommandLine, FieldsOfViewOutOfRangeAreRefused) {
  for (const char* camera : {"perspective:fov_deg=180", "perspective:fov_deg=0", "equidistant:fov_deg=361",
                             "equidistant:fov_deg=-90", "equidistant:fov_deg=nan", "equidistant:fov_deg=wide",
                             "stereographic:fov_deg=360", "orthographic_fisheye:fov_deg=181"}) {
    expect_refusal({"render", "facade", "--camera", camera, "-o", "a.png"}, 2, {"fov_deg"});
  }
}

TEST_F(CommandLine, SizesOutOfRangeAreRefused) {
  for (const char* size : {"0x10", "10x0", "-5x10", "10x-5", "99999999x10", "99999999999999999999x1", "10", "x", "10x",
                           "10x10x10", "axb", "1.5x2"}) {
    expect_refusal(render({"--size", size, "-o", "a.png"}), 2, {"--size"});
  }
}

TEST_F(CommandLine, NumbersOutOfRangeAreRefused) {
  for (const char* option : {"--samples", "--tile", "--face-size"}) {
    for (const char* value : {"0", "-1", "99999999", "many", "1.5"}) {
      expect_refusal(render({option, value, "-o", "a.png"}), 2, {option});
    }
  }
  expect_refusal(render({"--background", "red", "-o", "a.png"}), 2, {"--background"});
  expect_refusal(render({"--background", "-1,0,0", "-o", "a.png"}), 2, {"--background"});
  expect_refusal(render({"--from", "1,2", "-o", "a.png"}), 2, {"--from", "x,y,z"});
  expect_refusal(render({"--from", "1,2,z", "-o", "a.png"}), 2, {"--from", "'z'"});
  expect_refusal(render({"--time", "noon", "-o", "a.png"}), 2, {"--time"});
}

TEST_F(CommandLine, OutputsThatCannotBeAreRefused) {
  write("here", "a file");
  expect_refusal(render({"-o", "missing/a.png"}), 2, {"missing", "does not exist"});
  expect_refusal(render({"-o", "here/a.png"}), 2, {"here", "not a folder"});
  expect_refusal(render({"-o", "a.gif"}), 2, {".gif", ".png"});
  expect_refusal(render({"-o", "a"}), 2, {".png"});
  expect_refusal(render({"-o", "a.png:distance"}), 2, {".exr", ".pfm", ".npy"});
  expect_refusal(render({"-o", "a.png:"}), 2, {"channel"});
  expect_refusal(render({"-o", "a.png", "-o", "./a.png:id"}), 2, {"twice"});
  expect_refusal(render({"-o", "a.png", "--stats", "missing/s.json"}), 2, {"missing", "does not exist"});
}

TEST_F(CommandLine, ContradictionsAreRefused) {
  write("poses.txt", "0 0 0 0 0 0 0 1\n");
  expect_refusal(render({"--pose", "poses.txt", "--from", "0,0,0", "-o", "a.png"}), 2, {"--pose", "--from"});
  expect_refusal(render({"--pose", "poses.txt", "--frames", "3", "-o", "a_%d.png"}), 2, {"--pose", "--frames"});
  expect_refusal(render({"--from", "1,2,3", "--to", "1,2,3", "-o", "a.png"}), 2, {"--from", "--to"});
  expect_refusal(render({"--up", "0,0,0", "-o", "a.png"}), 2, {"--up"});
  expect_refusal(render({"--fps", "3", "-o", "a.png"}), 2, {"--fps", "--frames"});
  expect_refusal(render({"--frames", "3", "-o", "a.png"}), 2, {"a_%04d.png"});
  expect_refusal(render({"--frames", "3", "-o", "a_%s.png"}), 2, {"%04d"});
  expect_refusal(render({"--frames", "3", "-o", "a_%d_%d.png"}), 2, {"two places"});
  expect_refusal(render({"-o", "a_%04d.png"}), 2, {"--frames"});
  expect_refusal(render({"--effect", "brick", "--effect", "checker", "-o", "a.png"}), 2, {"brick", "checker"});
  expect_refusal(render({"--effect", "brick", "-o", "a.exr:distance"}), 2, {"--effect", "colour"});
  expect_refusal({"render", "facade", "--camera", "equidistant:fov_deg=90,f=100", "-o", "a.png"}, 2, {"twice"});
}

}  // namespace
}  // namespace omma
