// Scene files that the tests write themselves: what a format means, and what happens when it is broken.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "omma/base/error.h"
#include "omma/scene/scene.h"
#include "tests/unit/scene_invariants.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

class SceneFileTest : public ::testing::Test {
 protected:
  SceneFileTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / fmt::format("omma_{}_{}_{}", info->test_suite_name(), info->name(), getpid());
    fs::create_directories(folder_);
  }
  ~SceneFileTest() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  /// A binary PLY of these positions and triangles.
  fs::path write_ply(const std::string& name, const std::vector<glm::vec3>& positions,
                     const std::vector<glm::ivec3>& triangles) const {
    std::string text = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.size(), triangles.size());
    text.append(reinterpret_cast<const char*>(positions.data()), positions.size() * sizeof(glm::vec3));
    for (const glm::ivec3& t : triangles) {
      text += '\3';
      text.append(reinterpret_cast<const char*>(&t), sizeof t);
    }
    return write(name, text);
  }

  /// 32-bit TGA, rows from the top.
  void write_tga(const std::string& name, int width, int height, const std::vector<glm::u8vec4>& texels) const {
    std::string text(18, '\0');
    text[2] = 2;
    text[12] = static_cast<char>(width & 255);
    text[13] = static_cast<char>(width >> 8);
    text[14] = static_cast<char>(height & 255);
    text[15] = static_cast<char>(height >> 8);
    text[16] = 32;
    text[17] = 0x28;
    for (const glm::u8vec4& t : texels) {
      for (const uint8_t value : {t.b, t.g, t.r, t.a}) text += static_cast<char>(value);
    }
    write(name, text);
  }

  /// A glTF of one unit square in the xy plane with uvs; `json` continues the top-level object.
  fs::path write_gltf(const std::string& json, const std::string& nodes = R"([{"mesh": 0}])",
                      const std::vector<uint16_t>& indices = {0, 1, 2, 0, 2, 3}) const {
    const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, uvs[] = {0, 1, 1, 1, 1, 0, 0, 0};
    std::string buffer(reinterpret_cast<const char*>(positions), sizeof positions);
    buffer.append(reinterpret_cast<const char*>(uvs), sizeof uvs);
    buffer.append(reinterpret_cast<const char*>(indices.data()), indices.size() * 2);
    write("square.bin", buffer);
    return write("square.gltf",
                 fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
      "nodes": {},
      "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2, "material": 0}}]}}],
      "accessors": [
        {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
        {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
        {{"bufferView": 2, "componentType": 5123, "count": {}, "type": "SCALAR"}}],
      "bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 48}},
        {{"buffer": 0, "byteOffset": 48, "byteLength": 32}}, {{"buffer": 0, "byteOffset": 80, "byteLength": {}}}],
      "buffers": [{{"uri": "square.bin", "byteLength": {}}}], {}}})",
                             nodes, indices.size(), indices.size() * 2, buffer.size(), json));
  }

  std::string refusal(const fs::path& path) const {
    try {
      load_scene(path.string());
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
      return error.what();
    }
    ADD_FAILURE() << path << " was accepted";
    return "";
  }

  fs::path folder_;
};

const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST_F(SceneFileTest, MissingFolderEmptyAndUnknownFormatsAreRefused) {
  EXPECT_NE(refusal(folder_ / "nothing.obj").find("does not exist"), std::string::npos);
  fs::create_directory(folder_ / "folder.obj");
  EXPECT_NE(refusal(folder_ / "folder.obj").find("not a file"), std::string::npos);
  EXPECT_NE(refusal(write("empty.glb", "")).find("empty"), std::string::npos);
  EXPECT_NE(refusal(write("scene.docx", "text")).find(".gltf"), std::string::npos);
}

TEST_F(SceneFileTest, GarbageOfEveryFormatIsRefused) {
  std::string noise;
  uint32_t state = 1;
  for (int i = 0; i < 4096; ++i) noise += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
  for (const char* extension : {"gltf", "glb", "obj", "ply", "stl", "dae", "fbx"}) {
    SCOPED_TRACE(extension);
    refusal(write(fmt::format("noise.{}", extension), noise));
    refusal(write(fmt::format("text.{}", extension), "This is no scene at all.\n"));
  }
}

TEST_F(SceneFileTest, TruncatedFilesAreRefusedOrSoundAtEveryLength) {
  write_gltf(R"("materials": [{}])");
  const fs::path ply = write_ply("square.ply", corners, {{0, 1, 2}, {0, 2, 3}});
  for (const fs::path& whole : {folder_ / "square.gltf", ply}) {
    std::ifstream stream(whole, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    for (size_t length = 1; length < content.size(); length += 7) {
      const fs::path path = write("cut" + whole.extension().string(), content.substr(0, length));
      try {
        expect_sound(load_scene_file(path));
      } catch (const InputError&) {
      }
    }
  }
  fs::resize_file(folder_ / "square.bin", 40);
  refusal(folder_ / "square.gltf");
}

TEST_F(SceneFileTest, PointsAndLinesAloneAreRefusedAndCounted) {
  EXPECT_NE(refusal(write("lines.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2\nl 2 3\n")).find("points and lines"),
            std::string::npos);
}

TEST_F(SceneFileTest, IndicesOutOfRangeAreRefused) {
  refusal(write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"));
  EXPECT_NE(refusal(write_ply("far.ply", corners, {{0, 1, 2}, {0, 1, 77}})).find("77"), std::string::npos);
  EXPECT_NE(refusal(write_ply("negative.ply", corners, {{0, 1, -1}})).find("out of range"), std::string::npos);
  EXPECT_NE(refusal(write_gltf(R"("materials": [{}])", R"([{"mesh": 0}])", {0, 1, 2, 0, 2, 300})).find("out of range"),
            std::string::npos);
}

TEST_F(SceneFileTest, TrianglesWithNanOrInfinityAreDroppedAndCounted) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<glm::vec3> positions = corners;
  positions.insert(positions.end(), {{nan, 0, 0}, {0, inf, 0}});
  const fs::path path = write_ply("nan.ply", positions, {{0, 1, 2}, {0, 1, 4}, {5, 1, 2}, {0, 2, 3}});
  ::testing::internal::CaptureStderr();
  const Scene scene = load_scene_file(path);
  const std::string said = ::testing::internal::GetCapturedStderr();
  expect_sound(scene);
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_NE(said.find("2 triangles with a vertex at NaN or infinity dropped"), std::string::npos) << said;
  EXPECT_NE(refusal(write_ply("all.ply", {{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})).find("1 triangles"),
            std::string::npos);
}

TEST_F(SceneFileTest, DegenerateTrianglesKeepTheirIds) {
  const Scene scene = load_scene_file(write_ply("flat.ply", corners, {{0, 0, 0}, {0, 1, 2}, {1, 1, 2}, {0, 2, 3}}));
  expect_sound(scene);
  EXPECT_EQ(scene.triangle_count(), 4u);
}

TEST_F(SceneFileTest, MissingAndBrokenTexturesBecomeAMagentaChecker) {
  write("broken.png", "\x89PNG\r\n\x1a\n and then nothing of use");
  // A bitmap's header that claims 60000 x 60000.
  std::string huge(54, '\0');
  huge[0] = 'B', huge[1] = 'M', huge[10] = 54, huge[14] = 40, huge[26] = 1, huge[28] = 24;
  const int32_t side = 60000;
  std::memcpy(&huge[18], &side, 4);
  std::memcpy(&huge[22], &side, 4);
  write("huge.bmp", huge);
  for (const char* name : {"missing.png", "broken.png", "huge.bmp", "square.gltf"}) {
    SCOPED_TRACE(name);
    const fs::path path = write_gltf(fmt::format(
        R"("materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}],
           "textures": [{{"source": 0}}], "images": [{{"uri": "{}"}}])",
        name));
    ::testing::internal::CaptureStderr();
    const Scene scene = load_scene_file(path);
    const std::string said = ::testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find(name), std::string::npos) << said;
    expect_sound(scene);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].texels[0], glm::u8vec4(255, 0, 255, 255));
    EXPECT_EQ(scene.textures[0].texels[8], glm::u8vec4(0, 0, 0, 255));
  }
}

TEST_F(SceneFileTest, TexturesLieWithTheirFirstRowAtVZero) {
  const glm::u8vec4 red(255, 0, 0, 255), green(0, 255, 0, 255), blue(0, 0, 255, 255), clear(200, 100, 50, 0);
  write_tga("colors.tga", 2, 2, {red, green, blue, clear});
  const auto check = [&](const Scene& scene) {
    expect_sound(scene);
    ASSERT_EQ(scene.textures.size(), 1u);
    // The transparent texel keeps its colour: alpha is not multiplied in.
    EXPECT_EQ(scene.textures[0].texels, (std::vector<glm::u8vec4>{red, green, blue, clear}));
    const Mesh& mesh = scene.meshes[0];
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_FLOAT_EQ(mesh.uvs[i].x, mesh.positions[i].x);
      EXPECT_FLOAT_EQ(mesh.uvs[i].y, 1.0f - mesh.positions[i].y);
    }
  };
  check(load_scene_file(write_gltf(R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
      "textures": [{"source": 0}], "images": [{"uri": "colors.tga"}])")));
  write("square.mtl", "newmtl painted\nKd 0 0 0\nmap_Kd .\\COLORS.TGA\n");
  const Scene obj = load_scene_file(
      write("square.obj",
            "mtllib square.mtl\nusemtl painted\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
            "f 1/1 2/2 3/3 4/4\n"));
  check(obj);
  EXPECT_EQ(obj.materials[0].alpha, Material::Alpha::mask);
  EXPECT_TRUE(obj.materials[0].double_sided);
  EXPECT_EQ(obj.materials[0].base_color, glm::vec4(1.0f)) << "black under a picture is an exporter's habit";
}

TEST_F(SceneFileTest, MapsThatAreNotDrawnAreSaid) {
  write_tga("a.tga", 1, 1, {{1, 2, 3, 255}});
  write("maps.mtl", "newmtl m\nmap_Kd a.tga\nmap_d holes.tga\nmap_bump bumps.tga\n");
  ::testing::internal::CaptureStderr();
  load_scene_file(write("maps.obj", "mtllib maps.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("1 opacity maps"), std::string::npos) << said;
  EXPECT_NE(said.find("1 height maps"), std::string::npos) << said;
}

TEST_F(SceneFileTest, GltfMaterialsSayEverythingThemselves) {
  const auto material = [&](const std::string& json) {
    return load_scene_file(write_gltf(R"("extensionsUsed": ["KHR_materials_unlit"], "materials": [)" + json + "]"))
        .materials.at(0);
  };
  const Material plain = material("{}");
  EXPECT_EQ(plain.alpha, Material::Alpha::opaque);
  EXPECT_FALSE(plain.double_sided);
  EXPECT_FALSE(plain.unlit);
  EXPECT_EQ(plain.base_color, glm::vec4(1.0f));
  EXPECT_EQ(plain.metallic, 1.0f);
  EXPECT_EQ(plain.roughness, 1.0f);
  const Material full = material(R"({"name": "full", "alphaMode": "MASK", "alphaCutoff": 0.3, "doubleSided": true,
      "emissiveFactor": [0.1, 0.2, 0.3],
      "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.75], "metallicFactor": 0.2, "roughnessFactor": 0.6}})");
  EXPECT_EQ(full.name, "full");
  EXPECT_EQ(full.alpha, Material::Alpha::mask);
  EXPECT_FLOAT_EQ(full.alpha_cutoff, 0.3f);
  EXPECT_TRUE(full.double_sided);
  EXPECT_EQ(full.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 0.75f));
  EXPECT_FLOAT_EQ(full.metallic, 0.2f);
  EXPECT_FLOAT_EQ(full.roughness, 0.6f);
  EXPECT_EQ(full.emissive, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(material(R"({"alphaMode": "BLEND"})").alpha, Material::Alpha::blend);
  EXPECT_TRUE(material(R"({"extensions": {"KHR_materials_unlit": {}}})").unlit);
}

TEST_F(SceneFileTest, GltfTexturesKeepTheirRolesAndWrapping) {
  write_tga("a.tga", 1, 1, {{1, 2, 3, 4}});
  const Scene scene = load_scene_file(write_gltf(
      R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
         "normalTexture": {"index": 1, "scale": 0.5}, "emissiveTexture": {"index": 0}}],
         "textures": [{"source": 0, "sampler": 0}, {"source": 0}], "images": [{"uri": "a.tga"}],
         "samplers": [{"wrapS": 33071, "wrapT": 33648}])"));
  expect_sound(scene);
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.base_color_texture, material.emissive_texture);
  EXPECT_EQ(material.metallic_roughness_texture, material.normal_texture);
  EXPECT_FLOAT_EQ(material.normal_scale, 0.5f);
  const Texture& color = scene.textures.at(static_cast<size_t>(material.base_color_texture));
  const Texture& normal = scene.textures.at(static_cast<size_t>(material.normal_texture));
  EXPECT_TRUE(color.srgb);
  EXPECT_EQ(color.wrap_u, Texture::Wrap::clamp);
  EXPECT_EQ(color.wrap_v, Texture::Wrap::mirror);
  EXPECT_FALSE(normal.srgb);
  EXPECT_EQ(normal.wrap_u, Texture::Wrap::repeat);
  // u runs along +x and v down, so the bitangent, the picture's up, is +y: w = 1.
  for (const glm::vec4& tangent : scene.meshes[0].tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.meshes[0].tangents.size(), 4u);
}

TEST_F(SceneFileTest, NodesAreInstancesOfOneMeshUnderTheirTransforms) {
  const Scene scene = load_scene_file(write_gltf(R"("materials": [{}])", R"([
      {"children": [1, 2], "translation": [10, 0, 0], "scale": [2, 2, 2]},
      {"mesh": 0, "name": "left"},
      {"mesh": 0, "name": "right", "translation": [0, 3, 0], "rotation": [0, 0.70710678, 0, 0.70710678]}])"));
  expect_sound(scene);
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_NE(scene.instances[0].object, scene.instances[1].object);
  const glm::dvec3 corner(scene.instances[1].worldFromObject * glm::dvec4(1, 1, 0, 1));
  EXPECT_LT(glm::distance(corner, glm::dvec3(10, 8, -2)), 1e-6);
}

TEST_F(SceneFileTest, ShearSurvivesAsAMatrix) {
  const Scene scene = load_scene_file(
      write_gltf(R"("materials": [{}])", R"([{"mesh": 0, "matrix": [1,0,0,0, 0.5,1,0,0, 0,0,1,0, 4,5,6,1]}])"));
  const glm::dvec3 corner(scene.instances[0].worldFromObject * glm::dvec4(0, 1, 0, 1));
  EXPECT_LT(glm::distance(corner, glm::dvec3(4.5, 6, 6)), 1e-6);
}

TEST_F(SceneFileTest, PunctualLightsAndCamerasStandWhereTheirNodesAre) {
  const Scene scene = load_scene_file(write_gltf(
      R"("materials": [{}], "extensionsUsed": ["KHR_lights_punctual"],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
      "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 20, "color": [1, 0.5, 0.25], "range": 7,
         "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}},
        {"type": "directional", "intensity": 3}, {"type": "point", "intensity": 5}]}})",
      R"([{"mesh": 0, "children": [1, 2, 3, 4]},
      {"name": "spot", "translation": [0, 4, 0], "rotation": [-0.70710678, 0, 0, 0.70710678],
       "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 1}}},
      {"name": "bulb", "translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 2}}},
      {"name": "eye", "camera": 0, "translation": [0, 0, 9], "scale": [2, 2, 2]}])"));
  expect_sound(scene);
  ASSERT_EQ(scene.lights.size(), 3u);
  const Light &spot = scene.lights[0], &sun = scene.lights[1], &bulb = scene.lights[2];
  EXPECT_EQ(spot.kind, Light::Kind::spot);
  EXPECT_EQ(spot.color, glm::vec3(20, 10, 5));
  EXPECT_FLOAT_EQ(spot.range, 7.0f);
  EXPECT_FLOAT_EQ(spot.inner_angle, 0.2f);
  EXPECT_FLOAT_EQ(spot.outer_angle, 0.4f);
  EXPECT_LT(glm::distance(spot.position, glm::dvec3(0, 4, 0)), 1e-6);
  EXPECT_LT(glm::distance(spot.direction, glm::dvec3(0, -1, 0)), 1e-6);
  EXPECT_EQ(sun.kind, Light::Kind::sun);
  EXPECT_EQ(sun.color, glm::vec3(3.0f));
  EXPECT_LT(glm::distance(sun.direction, glm::dvec3(0, 0, -1)), 1e-6);
  EXPECT_EQ(bulb.kind, Light::Kind::point);
  EXPECT_LT(glm::distance(bulb.position, glm::dvec3(1, 2, 3)), 1e-6);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_LT(glm::distance(glm::dvec3(scene.cameras[0].worldFromCamera[3]), glm::dvec3(0, 0, 9)), 1e-6);
}

TEST_F(SceneFileTest, MissingNormalsAreSmoothBelowTheCreaseAndSharpAbove) {
  // A cube: every face keeps its own normal, so each corner is three vertices.
  const std::vector<glm::vec3> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const Scene sharp = load_scene_file(write_ply("cube.ply", cube,
                                                {{0, 2, 1},
                                                 {0, 3, 2},
                                                 {4, 5, 6},
                                                 {4, 6, 7},
                                                 {0, 1, 5},
                                                 {0, 5, 4},
                                                 {3, 6, 2},
                                                 {3, 7, 6},
                                                 {1, 2, 6},
                                                 {1, 6, 5},
                                                 {0, 4, 7},
                                                 {0, 7, 3}}));
  expect_sound(sharp);
  EXPECT_EQ(sharp.meshes[0].positions.size(), 24u);
  // A shallow ridge of 2 x 20 degrees: one normal along it.
  const float h = std::tan(0.349066f);
  const Scene smooth =
      load_scene_file(write_ply("ridge.ply", {{-1, 0, 0}, {0, h, 0}, {0, h, -1}, {1, 0, 0}}, {{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(smooth.meshes[0].positions.size(), 4u);
}

TEST_F(SceneFileTest, PlyColorsArePictureValuesAndBecomeLinear) {
  const Scene scene = load_scene_file(write(
      "colored.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
      "red\n"
      "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 188 0\n1 0 0 255 188 0\n0 1 0 255 188 0\n3 0 1 2\n"));
  expect_sound(scene);
  ASSERT_EQ(scene.meshes[0].colors.size(), 3u);
  EXPECT_EQ(scene.meshes[0].colors[0].r, 255);
  EXPECT_NEAR(scene.meshes[0].colors[0].g, 128, 1);  // sRGB 188 is half the light
  EXPECT_EQ(scene.meshes[0].colors[0].b, 0);
  EXPECT_EQ(glm::vec3(scene.materials[0].base_color), glm::vec3(1.0f)) << "colours of vertices are not darkened";
}

TEST_F(SceneFileTest, FilesAreSeenFromInFrontUnlessTheySay) {
  const Scene scene = load_scene_file(write_ply("square.ply", corners, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(scene.default_to, glm::dvec3(0.5, 0.5, 0));
  EXPECT_GT(scene.default_from.z, 0.5);
  EXPECT_NEAR(glm::distance(scene.default_from, scene.default_to), 1.3 * std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(scene.default_is_guess);
}

}  // namespace
}  // namespace omma
