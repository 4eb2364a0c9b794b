// Scene files that hold nothing usable are refused, exit code 3; what can be repaired is repaired and said.
#include "omma/base/file.h"
#include "tests/cli/tool.h"
#include "tests/places.h"

namespace omma {
namespace {

class SceneFile : public ToolTest {
 protected:
  std::vector<std::string> render(const std::string& scene) const {
    return {"render", scene, "--camera", "equidistant", "--size", "16x16", "--samples", "1", "-o", "a.png"};
  }
};

const std::string two_triangles_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
    "f 1 2 3\nf 2 4 3\n";

TEST_F(SceneFile, MissingEmptyAndGarbageAreRefused) {
  expect_refusal(render("missing.glb"), 3, {"missing.glb", "does not exist"});
  std::filesystem::create_directory(file("folder.obj"));
  expect_refusal(render("folder.obj"), 3, {"folder.obj"});
  for (const char* name : {"a.obj", "a.glb", "a.gltf", "a.ply", "a.stl", "a.dae", "a.fbx"}) {
    write(name, "");
    expect_refusal(render(name), 3, {name});
    write(name, "\x01\x02 garbage \xff\xfe and no scene at all");
    expect_refusal(render(name), 3, {name});
  }
}

TEST_F(SceneFile, TruncatedFilesAreRefused) {
  const std::filesystem::path whole =
      std::filesystem::path(places::test_models) / "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb";
  if (!std::filesystem::exists(whole)) GTEST_SKIP() << "assimp-testmodels is not installed: " << whole;
  const std::string bytes = read_file(whole);
  for (const double share : {0.01, 0.1, 0.5, 0.9}) {
    write("a.glb", bytes.substr(0, size_t(share * double(bytes.size()))));
    expect_refusal(render("a.glb"), 3, {"a.glb"});
  }
}

TEST_F(SceneFile, WithoutTrianglesIsRefused) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  expect_refusal(render("a.obj"), 3, {"a.obj"});
  write("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n");
  expect_refusal(render("a.ply"), 3, {"a.ply"});
}

TEST_F(SceneFile, IndicesOutOfRangeAreRefused) {
  write("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 999\n");
  expect_refusal(render("a.ply"), 3, {"a.ply"});
}

TEST_F(SceneFile, BrokenModelsOfTheImporterAreRefused) {
  const std::filesystem::path models = std::filesystem::path(places::test_models) / "glTF2";
  if (!std::filesystem::exists(models)) GTEST_SKIP() << "assimp-testmodels is not installed: " << models;
  for (const char* name : {"IndexOutOfRange/IndexOutOfRange.gltf", "MissingBin/BoxTextured.gltf"}) {
    ASSERT_TRUE(std::filesystem::exists(models / name)) << name;
    expect_refusal(render((models / name).string()), 3, {name});
  }
}

TEST_F(SceneFile, VerticesThatAreNotFiniteAreDroppedAndCounted) {
  write("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n");
  const ToolResult result = run(render("a.ply"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("warning"), std::string::npos) << result.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.png")));
}

TEST_F(SceneFile, MissingTextureIsAWarning) {
  write("a.obj", "mtllib a.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n" + two_triangles_obj + "f 1/1 2/2 3/3\n");
  write("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd not_there.png\n");
  const ToolResult result = run(render("a.obj"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("not_there.png"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("warning"), std::string::npos);
}

TEST_F(SceneFile, NamesFilesWithinItsFolderOrTheRoot) {
  std::filesystem::create_directory(file("scene"));
  write("a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a.png\n");
  write("scene/a.obj", "mtllib ../a.mtl\nusemtl m\n" + two_triangles_obj);
  std::vector<std::string> words = render("scene/a.obj");
  const ToolResult without = run(words);
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.err.find("a.mtl: lies outside of the folder 'scene'; --root DIR"), std::string::npos)
      << without.err;
  words.insert(words.end(), {"--root", "."});
  const ToolResult with = run(words);
  EXPECT_EQ(with.exit_code, 0) << with.err;
  EXPECT_EQ(with.err.find("lies outside"), std::string::npos) << with.err;
  words.back() = "nowhere";
  expect_refusal(words, 2, {"--root nowhere", "no such folder"});
}

TEST_F(SceneFile, BeyondTheLimitsIsRefusedAndLimitsAreRaised) {
  write("a.obj", two_triangles_obj);
  std::vector<std::string> words = render("a.obj");
  words.insert(words.end(), {"--limit", "scene_triangles=1"});
  expect_refusal(words, 3, {"a.obj", "the limit 'scene_triangles' is 1; --limit scene_triangles=N"});
  words.back() = "scene_triangles=2";
  EXPECT_EQ(run(words).exit_code, 0);
  words.back() = "scene_triangle=2";
  std::filesystem::remove(file("a.png"));
  expect_refusal(words, 2, {"did you mean 'scene_triangles'"});
}

TEST_F(SceneFile, TimeOfASceneWithoutAnimationIsAWarning) {
  std::vector<std::string> words = render("facade");
  words.insert(words.end(), {"--time", "2"});
  const ToolResult result = run(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("no animation"), std::string::npos);
  words.insert(words.end(), {"--animation", "walk"});
  std::filesystem::remove(file("a.png"));
  expect_refusal(words, 2, {"walk"});
}

}  // namespace
}  // namespace omma
