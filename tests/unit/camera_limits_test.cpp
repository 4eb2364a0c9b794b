// Files of cameras and poses beyond the limits are refused with file, place, limit and how to raise it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "omma/base/file.h"
#include "omma/camera/deformation/warp.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/files/document.h"
#include "omma/camera/pose_file.h"
#include "omma/image/npy.h"
#include "tests/unit/camera_deformation.h"

namespace omma {
namespace {

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(DocumentLimit, ValuesAreCountedInEverySyntax) {
  const std::vector<std::pair<const char*, std::string>> texts = {
      {"json", std::string("[") + repeated("1,", 100) + "1]"},
      {"json of keys", std::string("{\"a\":[") + repeated("{\"b\":1},", 50) + "1]}"},
      {"yaml", std::string("a: [") + repeated("1,", 100) + "1]\n"},
      {"yaml by lines", std::string("a:\n") + repeated("- 1\n", 101)},
      {"xml", std::string("<a>") + repeated("<b/>", 101) + "</a>"},
      {"xml of attributes", std::string("<a>") + repeated("<b c='1'/>", 51) + "</a>"},
      {"lines", repeated("1 2\n", 51)}};
  for (const auto& [name, text] : texts) {
    SCOPED_TRACE(name);
    EXPECT_EQ(message_of([&] { parse_document("f", text); }), "accepted");
    expect_parts(message_of([&] { parse_document("f", text, {.document_values = 100}); }),
                 {"f:", "more than 100 values", "--limit document_values=N"});
  }
}

TEST(DocumentLimit, IsMetEarly) {
  // The parser stops at the limit, long before what would be wrong behind it.
  const std::string text = std::string("[") + repeated("1,\n", 1000) + "}";
  expect_parts(message_of([&] { parse_document("f", text, {.document_values = 10}); }), {"f:10:", "more than 10"});
  expect_parts(message_of([&] { parse_document("f", text); }), {"is no JSON"});
}

TEST(DocumentLimit, DepthAndBytes) {
  const std::string deep = repeated("[", 40) + repeated("]", 40);
  expect_parts(message_of([&] { parse_document("f", deep); }), {"more than 32 levels", "--limit document_depth=N"});
  EXPECT_EQ(message_of([&] { parse_document("f", deep, {.document_depth = 40}); }), "accepted");
  expect_parts(message_of([&] { parse_document("f", deep, {.document_bytes = 79}); }),
               {"80 bytes", "--limit document_bytes=N"});
}

using CameraLimit = Deformation;

TEST_F(CameraLimit, CalibrationFilesAreNotReadBeyondTheirs) {
  const std::string name = file("camera.json", repeated(" ", 5000) + "{}");
  expect_parts(message_of([&] { CameraFile::load(name, {.document_bytes = 5000}); }),
               {name, "5000 bytes", "--limit document_bytes=N"});
  expect_parts(message_of([&] { make_camera(name, size, {.document_bytes = 5000}); }), {"--limit document_bytes=N"});
}

TEST_F(CameraLimit, ImagesHaveAnAreaToo) {
  for (const char* text : {"equidistant", "expression:r=theta,fov_deg=90"}) {
    expect_parts(message_of([&] {
                   make_camera(fmt::format("{}{}width=65536,height=65536", text,
                                           std::string_view(text).find(':') == std::string_view::npos ? ":" : ","));
                 }),
                 {"65536 x 65536", "1 to 65536", "1073741824 in all"});
  }
  expect_parts(message_of([] { make_camera("perspective", ImageSize{65536, 65536}); }), {"1073741824 in all"});
  const std::string calibration = file("c.json", R"({"image_size": [65536, 65536], "camera_matrix":
    [100, 0, 50, 0, 100, 50, 0, 0, 1], "distortion_coefficients": [0, 0, 0, 0]})");
  EXPECT_NE(message_of([&] { make_camera(calibration); }), "accepted");
}

TEST_F(CameraLimit, DeformedCamerasAreNotMadeBeyondThePixels) {
  const Limits limits{.picture_pixels = size_t(size.width) * size_t(size.height) - 1};
  const std::string mesh = file("mesh.obj", "v -1 -1\nv 1 -1\nv 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nf 1 2 3\n");
  const std::string table = file("table.txt", "0 0\n90 1\n");
  for (const std::string& text :
       {std::string("expression:r=theta,fov_deg=90"), std::string("expression:longitude=u,latitude=v"),
        "table:file=" + table, fmt::format("warp_mesh:file={},base=equidistant,fov_deg=90", mesh)}) {
    EXPECT_EQ(message_of([&] { make_camera(text, size); }), "accepted") << text;
    expect_parts(message_of([&] { make_camera(text, size, limits); }), {"160 x 120", "--limit picture_pixels=N"});
  }
}

TEST_F(CameraLimit, RayMapsAndMeshes) {
  const std::array<size_t, 3> shape{2, 5, 3};
  const std::vector<float> rays(30, 1.0F);
  write_npy<float>(path("rays.npy"), shape, rays);
  EXPECT_EQ(message_of([&] { load_ray_map(path("rays.npy"), {.picture_pixels = 10}); }), "accepted");
  expect_parts(message_of([&] { load_ray_map(path("rays.npy"), {.picture_pixels = 9}); }),
               {path("rays.npy"), "5 x 2 pixels", "--limit picture_pixels=N"});
  const Limits few{.warp_nodes = 5};
  const std::string grid = file("grid.data", std::string("2\n2 3\n") + repeated("0 0 0 0 1\n", 6));
  const std::string many = file("many.obj", repeated("v 0 0\n", 6));
  for (const std::string& name : {grid, many}) {
    expect_parts(message_of([&] { read_warp_mesh(name, 1.0, few); }), {name, "--limit warp_nodes=N"});
  }
  EXPECT_EQ(message_of([&] { read_warp_mesh(grid, 1.0, {.warp_nodes = 6}); }), "accepted");
  // More lines than the header says are counted, not kept.
  const std::string longer = file("longer.data", std::string("2\n2 3\n") + repeated("0 0 0 0 1\n", 600));
  expect_parts(message_of([&] { read_warp_mesh(longer, 1.0); }), {"600 lines of nodes; 2 x 3 are expected"});
}

TEST_F(CameraLimit, Poses) {
  const std::string name = file("poses.txt", repeated("0 0 0 0 0 0 0 1\n", 4));
  EXPECT_EQ(load_poses(name, {.poses = 4}).size(), 4U);
  expect_parts(message_of([&] { load_poses(name, {.poses = 3}); }), {name + ":4", "--limit poses=N"});
  // The points of an image are a line without end that is counted alone.
  const std::string points =
      file("images.txt", std::string("1 1 0 0 0 0 0 0 1 a.png\n") + repeated("1 2 3 ", 50000) + "\n");
  EXPECT_EQ(load_poses(points).size(), 1U);
  expect_parts(message_of([&] { load_poses(file("long.txt", repeated("1 ", 50000))); }), {"65536 are accepted"});
}

TEST_F(CameraLimit, PipesAreRefusedByEveryReader) {
  const std::string pipe = path("pipe");
  for (const char* extension : {".json", ".npy", ".txt", ".obj", ".data", ".pfm", ".exr"}) {
    const std::string name = pipe + extension;
    ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0);
    for (const std::string& text : {name, "table:file=" + name, "expression:file=" + name,
                                    fmt::format("camera_texture:file={},base=perspective,fov_deg=90", name),
                                    fmt::format("warp_mesh:file={},base=equidistant,fov_deg=90", name)}) {
      EXPECT_NE(message_of([&] { make_camera(text, size); }), "accepted") << text;
    }
    EXPECT_NE(message_of([&] { load_poses(name); }), "accepted");
  }
}

}  // namespace
}  // namespace omma
