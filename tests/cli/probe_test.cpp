// omma probe: one point, lists of points, an object's vertices, refusals.
#include <cmath>
#include <nlohmann/json.hpp>

#include "omma/base/file.h"
#include "omma/image/npy.h"
#include "tests/cli/tool.h"

namespace omma {
namespace {

class ProbeCommand : public ToolTest {
 protected:
  void write_array(const std::string& name, const std::vector<size_t>& shape, const std::vector<double>& values) const {
    write_npy<double>(file(name), shape, values);
  }
};

TEST_F(ProbeCommand, OnePointIsPrinted) {
  const ToolResult result = run(
      {"probe", "temple", "--at", "0,50,0", "--normal", "0,2,0", "--background", "1,0.5,0", "--size", "32", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["occlusion"], 0.0);
  EXPECT_EQ(json["sky"], 1.0);
  EXPECT_NEAR(json["irradiance"][0].get<double>(), 3.14159, 1e-3);
  EXPECT_NEAR(json["irradiance"][1].get<double>(), 1.5708, 1e-3);
  EXPECT_NEAR(json["open_solid_angle_sr"].get<double>(), 6.28319, 1e-4);
  const ToolResult text = run({"probe", "temple", "--at", "0,50,0", "--normal", "0,1,0", "--size", "16"});
  EXPECT_NE(text.out.find("occlusion         0.0000"), std::string::npos) << text.out;
}

TEST_F(ProbeCommand, ListsGoToFiles) {
  write_array("points.npy", {2, 6}, {0, 50, 0, 0, 1, 0, 0, 0.5, 40, 0, -1, 0});
  const ToolResult result = run({"probe", "temple", "--points", "points.npy", "--size", "32", "-o", "out.npy"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("2 points"), std::string::npos) << result.err;
  const NpyArray<double> out = read_npy<double>(file("out.npy"));
  ASSERT_EQ(out.shape, (std::vector<size_t>{2, 12}));
  EXPECT_EQ(out.values[1], 50.0);
  EXPECT_EQ(out.values[6], 0.0);       // looks into the sky
  EXPECT_GT(out.values[12 + 6], 0.9);  // looks at the ground
  EXPECT_LT(out.values[12 + 11], 0.3);
}

TEST_F(ProbeCommand, VerticesOfAnObjectBecomeAMesh) {
  const ToolResult result = run({"probe", "room", "--vertices", "rug", "--size", "16", "-o", "rug.ply"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string ply = read_file(file("rug.ply"));
  EXPECT_TRUE(ply.starts_with("ply\nformat binary_little_endian 1.0\n"));
  const auto count = [&](const std::string& element) {
    const size_t at = ply.find("element " + element + " ");
    return at == std::string::npos ? 0 : std::stoul(ply.substr(at + element.size() + 9));
  };
  EXPECT_GE(count("vertex"), 8u);
  EXPECT_GE(count("face"), 2u);
  const size_t body = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - body, count("vertex") * (13 * 4 + 3) + count("face") * 13);
}

TEST_F(ProbeCommand, RefusalsSayWhatIsWrong) {
  const auto refused_at = [&](const std::vector<std::string>& more, const std::vector<std::string>& fragments) {
    std::vector<std::string> words{"probe", "room", "--at", "0,1,0", "--normal", "0,1,0"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refusal(words, 2, fragments);
  };
  expect_refusal({"probe", "room"}, 2, {"--at", "--points", "--vertices"});
  expect_refusal({"probe", "room", "--at", "0,1,0"}, 2, {"--normal"});
  expect_refusal({"probe", "room", "--at", "0,1,0", "--normal", "0,0,0"}, 2, {"--normal", "direction"});
  expect_refusal({"probe", "room", "--at", "0,1", "--normal", "0,1,0"}, 2, {"--at", "x,y,z"});
  refused_at({"--size", "4"}, {"--size", "8"});
  refused_at({"--technique", "planar"}, {"planar"});
  refused_at({"-o", "a.txt"}, {".npy", ".ply"});
  expect_refusal({"probe", "room", "--vertices", "rag", "-o", "a.ply"}, 2, {"did you mean 'rug'"});
  expect_refusal({"probe", "room", "--vertices", "99", "-o", "a.ply"}, 2, {"'99'", "number from 0"});
  expect_refusal({"probe", "room", "--vertices", "rug"}, 2, {"-o"});
  expect_refusal({"probe", "room", "--points", "none.npy", "-o", "a.npy"}, 3, {"none.npy"});
  write_array("three.npy", {2, 3}, {0, 1, 0, 0, 1, 1});
  expect_refusal({"probe", "room", "--points", "three.npy", "-o", "a.npy"}, 3, {"three.npy", "--normal"});
  write_array("six.npy", {1, 6}, {0, 1, 0, 0, 0, 0});
  expect_refusal({"probe", "room", "--points", "six.npy", "-o", "a.npy"}, 3, {"six.npy", "row 0", "no direction"});
  write_array("flat.npy", {6}, {0, 1, 0, 0, 1, 0});
  expect_refusal({"probe", "room", "--points", "flat.npy", "-o", "a.npy"}, 3, {"flat.npy", "K x 6"});
}

}  // namespace
}  // namespace omma
