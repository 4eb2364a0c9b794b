// omma render: one picture, its channels, its statistics, its view.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "omma/base/file.h"
#include "omma/image/read.h"
#include "tests/cli/tool.h"

namespace omma {
namespace {

class RenderCommand : public ToolTest {
 protected:
  std::vector<std::string> render(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"render", "facade", "--camera",  "equidistant:fov_deg=120",
                                   "--size", "48x32",  "--samples", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(RenderCommand, EveryChannelIsWritten) {
  std::vector<std::string> outputs;
  for (const ChannelInfo& info : channels()) {
    outputs.insert(outputs.end(), {"-o", fmt::format("{0}.exr:{0}", info.name)});
  }
  const ToolResult result = run(render(outputs));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const ChannelInfo& info : channels()) {
    SCOPED_TRACE(info.name);
    const Image image = read_image(file(fmt::format("{}.exr", info.name)));
    EXPECT_EQ(image_size(image), (ImageSize{48, 32}));
    EXPECT_EQ(image_components(image), info.components);
    EXPECT_EQ(std::holds_alternative<IntImage>(image), info.integer);
    // Not one value everywhere: facades have textures, depth, and an edge.
    std::visit(
        [&](const auto& typed) {
          const auto& values = typed.values;
          EXPECT_TRUE(std::any_of(values.begin(), values.end(), [&](auto value) { return value != values[0]; }));
        },
        image);
  }
}

TEST_F(RenderCommand, ShadowsDarkenAndTakeTheirTime) {
  const std::vector<std::string> view{"--from", "-30,20,-45", "--to", "0,3,0", "--camera", "perspective"};
  const auto temple = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render", "temple", "--size", "48x32", "--samples", "1", "--technique", "planar"};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  ASSERT_EQ(temple({"-o", "off.exr"}).exit_code, 0);
  ASSERT_EQ(temple({"-o", "on.exr", "--shadows", "cube", "--stats", "s.json"}).exit_code, 0);
  const auto off = std::get<FloatImage>(read_image(file("off.exr")));
  const auto on = std::get<FloatImage>(read_image(file("on.exr")));
  size_t darker = 0;
  for (size_t i = 0; i < on.values.size(); ++i) {
    EXPECT_LE(on.values[i], off.values[i] + 1e-3f);
    darker += on.values[i] < 0.9f * off.values[i];
  }
  EXPECT_GT(darker, 50u);
  EXPECT_LT(darker, on.values.size() / 2);
  const auto json = nlohmann::json::parse(read_file(file("s.json")));
  EXPECT_GT(json["frames"][0]["stages_ms"]["shadow maps"], 0.0);

  ToolResult refused = temple({"-o", "a.png", "--shadows", "cubes"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("did you mean 'cube'"), std::string::npos) << refused.err;
  refused = temple({"-o", "a.png", "--shadow-size", "512"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--shadows"), std::string::npos) << refused.err;
  EXPECT_EQ(temple({"-o", "a.png", "--shadows", "cube", "--shadow-size", "8"}).exit_code, 2);
}

TEST_F(RenderCommand, AnObjectReflects) {
  const auto room = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "render", "room",           "--size", "32x24", "--samples", "1", "--camera", "perspective:fov_deg=20",
        "--to",   "0.78,0.88,-1.25"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  ASSERT_EQ(room({"-o", "off.exr"}).exit_code, 0);
  ASSERT_EQ(room({"-o", "on.exr", "--reflect", "ring", "--reflection-size", "64", "--stats", "s.json"}).exit_code, 0);
  EXPECT_NE(read_file(file("off.exr")), read_file(file("on.exr")));
  const auto json = nlohmann::json::parse(read_file(file("s.json")));
  EXPECT_GT(json["frames"][0]["stages_ms"]["reflection maps"], 0.0);
  ToolResult refused = room({"-o", "a.png", "--reflect", "rings"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("did you mean 'ring'"), std::string::npos) << refused.err;
  refused = room({"-o", "a.png", "--reflection-size", "64"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--reflect"), std::string::npos) << refused.err;
}

TEST_F(RenderCommand, StatsHoldWhatItTook) {
  ASSERT_EQ(run(render({"-o", "a.png", "--stats", "stats.json", "--technique", "raycast"})).exit_code, 0);
  const auto json = nlohmann::json::parse(read_file(file("stats.json")));
  EXPECT_EQ(json["scene"], "facade");
  EXPECT_EQ(json["width"], 48);
  EXPECT_EQ(json["samples"], 1);
  EXPECT_GT(json["load_ms"], 0.0);
  EXPECT_EQ(json["frames_skipped"], 0);
  ASSERT_EQ(json["frames"].size(), 1u);
  const auto& frame = json["frames"][0];
  EXPECT_EQ(frame["files"][0], "a.png");
  EXPECT_TRUE(frame["technique"].get<std::string>().starts_with("raycast"));
  EXPECT_FALSE(frame["renderer"].get<std::string>().empty());
  EXPECT_GT(frame["triangles"], 100);
  EXPECT_GT(frame["triangles_drawn"], 0);
  EXPECT_GT(frame["fragments_shaded"], 0);
  EXPECT_GT(frame["samples_kept"], 0);
  EXPECT_NEAR(frame["replication"].get<double>(),
              frame["triangles_drawn"].get<double>() / frame["triangles"].get<double>(), 1e-9);
  EXPECT_GT(frame["buffer_bytes"], 1000);
  EXPECT_GE(frame["tiles"], 1);
  EXPECT_GT(frame["render_ms"], 0.0);
  EXPECT_FALSE(frame["stages_ms"].empty());
}

TEST_F(RenderCommand, ViewThatIsNotGivenIsSaid) {
  const ToolResult result = run(render({"-o", "a.png"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("view: "), std::string::npos);
  const ToolResult given = run(render({"-o", "b.png", "--from", "-3,1,20", "--to", "0,1,0"}));
  ASSERT_EQ(given.exit_code, 0) << given.err;
  EXPECT_EQ(given.err.find("view: "), std::string::npos);
}

TEST_F(RenderCommand, ViewThatIsSaidDrawsTheSamePicture) {
  write("pyramid.obj", "v 0 0 0\nv 1 0 0\nv 0 0 -1\nv 0.3 1.7 -0.2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
  const std::vector<std::string> words{"render", "pyramid.obj", "--camera", "equidistant:fov_deg=180",
                                       "--size", "64x64"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run(more);
  };
  const ToolResult result = with({"-o", "a.npy"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream said(result.err.substr(result.err.find("--from")));
  std::string word, from, to;
  said >> word >> from >> word >> to;
  ASSERT_EQ(with({"-o", "b.npy", "--from", from, "--to", to}).exit_code, 0);
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max-max", "0"}).exit_code, 0);
  // Another lens has another view of an object, and the same one in every frame.
  EXPECT_EQ(with({"-o", "c_%d.npy", "--frames", "2"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "c_0.npy", "c_1.npy", "--max-max", "0"}).exit_code, 0);
}

TEST_F(RenderCommand, NegativeNumbersAreValues) {
  ASSERT_EQ(run(render({"-o", "a.npy", "--from", "-3,1,20", "--to", "-.5,1,0"})).exit_code, 0);
  ASSERT_EQ(run(render({"-o", "b.npy", "--from=-3,1,20", "--to=-0.5,1,0"})).exit_code, 0);
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max-max", "0"}).exit_code, 0);
  ASSERT_EQ(run(render({"-o", "c.npy", "--from", "3,1,20", "--to", "-.5,1,0"})).exit_code, 0);
  EXPECT_EQ(run({"compare", "a.npy", "c.npy", "--max-max", "0"}).exit_code, 1);
}

TEST_F(RenderCommand, PoseFileIsTheSameAsFromAndTo) {
  // A TUM pose holds the optical frame, half a turn about x from the camera's.
  write("pose.txt", "# time x y z qx qy qz qw\n0 2 3 20 1 0 0 0\n");
  ASSERT_EQ(run(render({"-o", "a.npy", "--pose", "pose.txt"})).exit_code, 0);
  ASSERT_EQ(run(render({"-o", "b.npy", "--from", "2,3,20", "--to", "2,3,0"})).exit_code, 0);
  EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max-mean", "0.001"}).exit_code, 0);
}

TEST_F(RenderCommand, BrokenPoseFilesAreRefused) {
  expect_refusal(render({"-o", "a.png", "--pose", "missing.txt"}), 3, {"missing.txt", "no such file"});
  write("pose.txt", "");
  expect_refusal(render({"-o", "a.png", "--pose", "pose.txt"}), 3, {"pose.txt"});
  write("pose.txt", "0 0 0 0 0 0 0 1\n1 0 0 zero 0 0 0 1\n");
  expect_refusal(render({"-o", "a_%d.png", "--pose", "pose.txt"}), 3, {"pose.txt:2"});
  write("pose.glb", "garbage");
  expect_refusal(render({"-o", "a.png", "--pose", "pose.glb"}), 3, {"pose.glb"});
}

TEST_F(RenderCommand, EffectsAndEdgesAreDrawnOverThePicture) {
  ASSERT_EQ(run(render({"-o", "plain.npy"})).exit_code, 0);
  ASSERT_EQ(run(render({"-o", "edges.npy", "--show", "edges"})).exit_code, 0);
  ASSERT_EQ(run(render({"-o", "wires.npy", "--effect", "wireframe:width_px=2.5,color=ffffff"})).exit_code, 0);
  ASSERT_EQ(run(render({"-o", "both.npy", "--effect", "brick", "--effect", "contours:width_px=3"})).exit_code, 0);
  EXPECT_EQ(run({"compare", "plain.npy", "edges.npy", "--max-max", "0.2"}).exit_code, 1);
  EXPECT_EQ(run({"compare", "edges.npy", "wires.npy", "--max-max", "0"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "plain.npy", "both.npy", "--max-max", "0.2"}).exit_code, 1);
}

TEST_F(RenderCommand, BackgroundIsTheColourAsked) {
  ASSERT_EQ(
      run(render({"-o", "a.npy", "--background", "0.25,0.5,2", "--from", "0,500,0", "--to", "0,900,1"})).exit_code, 0);
  const FloatImage image = std::get<FloatImage>(read_image(file("a.npy")));
  const float* middle = image.at(24, 16);
  EXPECT_NEAR(middle[0], 0.25f, 1e-3);
  EXPECT_NEAR(middle[1], 0.5f, 1e-3);
  EXPECT_NEAR(middle[2], 2.0f, 1e-2);
}

}  // namespace
}  // namespace omma
