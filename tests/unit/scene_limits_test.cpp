// What a scene file may ask for, and which files it may name.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "omma/base/error.h"
#include "omma/scene/scene.h"
#include "tests/unit/scene_invariants.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

const glm::u8vec4 magenta(255, 0, 255, 255), green(0, 255, 0, 255);

class SceneLimit : public ::testing::Test {
 protected:
  SceneLimit() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    top_ = fs::temp_directory_path() / fmt::format("omma_{}_{}", info->name(), getpid());
    folder_ = top_ / "scene";
    fs::create_directories(folder_);
  }
  ~SceneLimit() override { fs::remove_all(top_); }

  static fs::path write(const fs::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  /// A TGA of one colour.
  static void write_picture(const fs::path& path, int width = 1, int height = 1) {
    std::string text(18, '\0');
    text[2] = 2;
    text[12] = static_cast<char>(width);
    text[14] = static_cast<char>(height);
    text[16] = 32;
    text[17] = 0x28;
    for (int i = 0; i < width * height; ++i) text += std::string("\0\xff\0\xff", 4);
    write(path, text);
  }

  /// A triangle for each name, painted with the picture.
  fs::path write_obj(const std::vector<std::string>& pictures) const {
    std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n", mtl;
    for (size_t i = 0; i < pictures.size(); ++i) {
      obj += fmt::format("usemtl m{}\nf 1/1 2/1 3/1\n", i);
      mtl += fmt::format("newmtl m{}\nmap_Kd {}\n", i, pictures[i]);
    }
    write(folder_ / "a.mtl", mtl);
    return write(folder_ / "a.obj", obj);
  }

  /// A triangle with `targets` morph targets, at each of the nodes, whose buffer is at `uri`; `more` continues the
  /// object.
  fs::path write_gltf(const std::string& uri, int nodes = 1, int targets = 0, const std::string& more = "") const {
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(positions), sizeof positions);
    if (fs::path(uri).is_relative()) write(folder_ / uri, bytes);
    std::string list, roots, morphs;
    for (int i = 0; i < nodes; ++i) {
      list += fmt::format(R"({}{{"mesh": 0}})", i ? "," : "");
      roots += fmt::format("{}{}", i ? "," : "", i);
    }
    for (int i = 0; i < targets; ++i) morphs += fmt::format(R"({}{{"POSITION": 0}})", i ? "," : "");
    if (!morphs.empty()) morphs = fmt::format(R"(, "targets": [{}])", morphs);
    return write(folder_ / "a.gltf", fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0,
      "scenes": [{{"nodes": [{}]}}], "nodes": [{}],
      "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}{}}}]}}],
      "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                      "max": [1, 1, 0]}}],
      "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
      "buffers": [{{"uri": "{}", "byteLength": 36}}]{}}})",
                                                 roots, list, morphs, uri, more));
  }

  /// The scene, and what was said.
  static std::pair<Scene, std::string> load(const fs::path& path, const ReadOptions& options = {}) {
    ::testing::internal::CaptureStderr();
    try {
      Scene scene = load_scene_file(path, options);
      return {std::move(scene), ::testing::internal::GetCapturedStderr()};
    } catch (...) {
      ::testing::internal::GetCapturedStderr();
      throw;
    }
  }

  static void expect_refused(const fs::path& path, const ReadOptions& options, const std::vector<std::string>& parts) {
    try {
      load(path, options);
      ADD_FAILURE() << path << " was accepted";
    } catch (const InputError& error) {
      for (const std::string& part : parts) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      }
    }
  }

  fs::path top_, folder_;
};

TEST_F(SceneLimit, PicturesOutsideOfTheFolderAreNotRead) {
  write_picture(top_ / "outside.tga");
  write_picture(folder_ / "inside.tga");
  fs::create_symlink(top_ / "outside.tga", folder_ / "link.tga");
  fs::create_symlink(top_, folder_ / "up");
  for (const std::string& name : {std::string("../outside.tga"), (top_ / "outside.tga").string(),
                                  std::string("link.tga"), std::string("up/outside.tga")}) {
    SCOPED_TRACE(name);
    const fs::path path = write_obj({name, "inside.tga"});
    const auto [scene, said] = load(path);
    expect_sound(scene);
    EXPECT_NE(said.find("outside of the folder"), std::string::npos) << said;
    EXPECT_NE(said.find("--root DIR"), std::string::npos) << said;
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_EQ(scene.textures[0].texels[0], magenta);
    EXPECT_EQ(scene.textures[1].texels[0], green);
    const auto [whole, nothing] = load(path, {.limits = {}, .root = top_});
    EXPECT_EQ(whole.textures[0].texels[0], green);
    EXPECT_EQ(nothing, "");
  }
}

TEST_F(SceneLimit, BuffersAndMaterialsOutsideOfTheFolderAreNotRead) {
  const fs::path gltf = write_gltf("../a.bin");
  expect_refused(gltf, {}, {"a.gltf", "a.bin", "outside of the folder", "--root DIR"});
  EXPECT_EQ(load(gltf, {.limits = {}, .root = top_}).first.triangle_count(), 1u);
  write(top_ / "a.mtl", "newmtl m\nKd 1 0 0\n");
  const fs::path obj = write(folder_ / "a.obj", "mtllib ../a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto [scene, said] = load(obj);
  EXPECT_NE(said.find("a.mtl: lies outside of the folder"), std::string::npos) << said;
  EXPECT_EQ(load(obj, {.limits = {}, .root = top_}).second, "");
}

TEST_F(SceneLimit, TheUsersOwnLinkIsFollowed) {
  fs::create_directory(top_ / "elsewhere");
  const fs::path obj = write_obj({"inside.tga"});
  write_picture(folder_ / "inside.tga");
  fs::create_directory_symlink(folder_, top_ / "link");
  EXPECT_EQ(load(top_ / "link" / "a.obj").second, "");
  fs::create_symlink(obj, top_ / "elsewhere" / "b.obj");
  EXPECT_NO_THROW(load(top_ / "elsewhere" / "b.obj"));
}

TEST_F(SceneLimit, PipesAreNotOpened) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.tga").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder_ / "pipe.obj").c_str(), 0600), 0);
  EXPECT_EQ(load(write_obj({"pipe.tga"})).first.textures[0].texels[0], magenta);
  expect_refused(folder_ / "pipe.obj", {}, {"pipe.obj"});
  const fs::path gltf = write_gltf("a.bin");
  fs::remove(folder_ / "a.bin");
  ASSERT_EQ(::mkfifo((folder_ / "a.bin").c_str(), 0600), 0);
  expect_refused(gltf, {}, {"a.bin", "pipe"});
}

TEST_F(SceneLimit, TexelsOfAllTexturesTogether) {
  for (const char* name : {"a.tga", "b.tga", "c.tga"}) write_picture(folder_ / name, 4, 4);
  const fs::path path = write_obj({"a.tga", "b.tga", "c.tga"});
  EXPECT_EQ(load(path, {.limits = {.scene_texels = 48}, .root = {}}).second, "");
  const auto [scene, said] = load(path, {.limits = {.scene_texels = 47}, .root = {}});
  EXPECT_NE(said.find("'c.tga'"), std::string::npos) << said;
  EXPECT_NE(said.find("--limit scene_texels=N"), std::string::npos) << said;
  EXPECT_EQ(scene.textures[1].texels[0], green);
  EXPECT_EQ(scene.textures[2].texels[0], magenta);
  EXPECT_EQ(load(path, {.limits = {.picture_pixels = 15}, .root = {}}).first.textures[0].texels[0], magenta);
}

TEST_F(SceneLimit, OnePictureOfManyNamesAndWrapsIsDecodedOnce) {
  write_picture(folder_ / "a.tga", 4, 4);
  fs::create_symlink("a.tga", folder_ / "same.tga");
  const fs::path path = write_obj({"a.tga", "./a.tga", "same.tga", "-clamp on a.tga"});
  const auto [scene, said] = load(path);
  ASSERT_EQ(scene.textures.size(), 4u);
  for (const Texture& texture : scene.textures) EXPECT_EQ(texture.texels, scene.textures[0].texels);
  // What cannot be decoded is said once.
  write(folder_ / "a.tga", "no picture");
  const auto [broken, warning] = load(path);
  EXPECT_EQ(warning.find("cannot be used"), warning.rfind("cannot be used")) << warning;
  for (const Texture& texture : broken.textures) EXPECT_EQ(texture.texels[0], magenta);
}

TEST_F(SceneLimit, MorphedMeshesAreCountedBeforeTheyAreCopied) {
  // 3 vertices and two targets of as many, for each node.
  const fs::path path = write_gltf("a.bin", 5, 2);
  EXPECT_EQ(load(path, {.limits = {.scene_vertices = 45}, .root = {}}).first.meshes.size(), 5u);
  expect_refused(path, {.limits = {.scene_vertices = 44}, .root = {}},
                 {path.string(), "45 vertices", "--limit scene_vertices=N"});
  const fs::path plain = write_gltf("a.bin", 5);
  EXPECT_NO_THROW(load(plain, {.limits = {.scene_vertices = 3}, .root = {}}));
  expect_refused(plain, {.limits = {.scene_vertices = 2}, .root = {}}, {"--limit scene_vertices=N"});
}

TEST_F(SceneLimit, TrianglesInstancesAndBytes) {
  const fs::path path = write_gltf("a.bin", 5);
  EXPECT_NO_THROW(load(path, {.limits = {.scene_triangles = 5, .scene_instances = 5}, .root = {}}));
  expect_refused(path, {.limits = {.scene_triangles = 4}, .root = {}}, {"a.gltf", "--limit scene_triangles=N"});
  expect_refused(path, {.limits = {.scene_instances = 4}, .root = {}}, {"a.gltf", "--limit scene_instances=N"});
  expect_refused(path, {.limits = {.file_bytes = 100}, .root = {}}, {"a.gltf", "--limit file_bytes=N"});
}

TEST_F(SceneLimit, DeepJsonIsRefusedBeforeItIsParsed) {
  const std::string deep = "{\"a\": \"]]\\\"[\", \"b\": " + std::string(100000, '[') + std::string(100000, ']') + "}";
  expect_refused(write(folder_ / "deep.gltf", deep), {}, {"deep.gltf", "--limit document_depth=N"});
  std::string binary("glTF\2\0\0\0\0\0\0\0", 12);
  const auto append = [&](uint32_t number) { binary.append(reinterpret_cast<const char*>(&number), 4); };
  append(static_cast<uint32_t>(deep.size()));
  binary += "JSON" + deep;
  expect_refused(write(folder_ / "deep.glb", binary), {}, {"deep.glb", "--limit document_depth=N"});
  const fs::path path = write_gltf("a.bin", 1, 0, R"(, "extras": {"text": "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["})");
  EXPECT_NO_THROW(load(path));
}

}  // namespace
}  // namespace omma
