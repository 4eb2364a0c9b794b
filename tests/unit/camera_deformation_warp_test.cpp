// Camera textures and warp meshes: that leave the base as it is, that move it by a known amount, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "omma/camera/deformation/deformation.h"
#include "omma/camera/deformation/warp.h"
#include "omma/image/pfm.h"
#include "omma/image/write.h"
#include "tests/places.h"
#include "tests/unit/camera_deformation.h"

namespace omma {
namespace {

// Corners of pieces are rounded to the grid: as far as that turns a ray, in radians of a camera of 160 pixels.
constexpr double on_grid = 5e-5;

FloatImage offsets(const ImageSize& texels, const std::function<glm::dvec2(const glm::dvec2&)>& offset) {
  FloatImage image(texels, 3, 0.0F);
  for (int y = 0; y < texels.height; ++y) {
    for (int x = 0; x < texels.width; ++x) {
      const glm::dvec2 value = offset({(x + 0.5) / texels.width, (y + 0.5) / texels.height});
      image.at(x, y)[0] = static_cast<float>(value.x);
      image.at(x, y)[1] = static_cast<float>(value.y);
    }
  }
  return image;
}

TEST_F(Deformation, NoOffsetLeavesTheBaseAsItIs) {
  write_pfm(path("zero.pfm"), offsets({5, 3}, [](const glm::dvec2&) { return glm::dvec2(0.0); }));
  for (const std::string base : {"perspective,fov_deg=90", "equidistant,fov_deg=180", "equirectangular"}) {
    std::string text = base;
    if (const size_t comma = text.find(','); comma != std::string::npos) text[comma] = ':';
    expect_equal(make_camera("camera_texture:file=" + path("zero.pfm") + ",base=" + base, size),
                 make_camera(text, size), base.starts_with("perspective") ? on_grid : 2e-7);
  }
  // 128 is the middle of an 8-bit file.
  FloatImage grey({4, 4}, 3, std::pow((128.0F / 255.0F + 0.055F) / 1.055F, 2.4F));
  write_image(path("grey.png"), grey, Channel::color);
  expect_equal(make_camera("camera_texture:base=perspective,file=" + path("grey.png"), size),
               make_camera("perspective", size), on_grid);
  // A lens with pixel values for an image of its own, at another size, and back to text.
  const Camera scaled = make_camera(
      "camera_texture:base=equidistant,f=100,cx=150,cy=120,width=320,height=240,file=" + path("zero.pfm"), size);
  expect_equal(scaled, make_camera("equidistant:f=100,cx=150,cy=120,width=320,height=240", size));
  expect_equal(make_camera(to_text(scaled)), scaled);
}

TEST_F(Deformation, OffsetsMoveWhatIsSeen) {
  // A quarter of the width to the right: what the base sees at x is seen at x + 40; the left edge shows nothing.
  write_pfm(path("shift.pfm"), offsets({3, 3}, [](const glm::dvec2&) { return glm::dvec2(0.25, 0.0); }));
  const Camera base = make_camera("perspective", size);
  const Camera shifted = make_camera("camera_texture:base=perspective,file=" + path("shift.pfm"), size);
  EXPECT_FALSE(shifted.unproject({20.5, 60.5}));
  EXPECT_LT(glm::distance(shifted.unproject({100.5, 60.5})->direction, base.unproject({60.5, 60.5})->direction),
            on_grid);
  const Camera halved = make_camera("camera_texture:strength=0.5,base=perspective,file=" + path("shift.pfm"), size);
  EXPECT_LT(glm::distance(halved.unproject({100.5, 60.5})->direction, base.unproject({80.5, 60.5})->direction),
            on_grid);

  // A shear along x that grows downwards: screen x = x + 0.2 (y - 0.5), away from the texture's rim exact.
  write_pfm(path("shear.pfm"), offsets({64, 64}, [](const glm::dvec2& p) { return glm::dvec2(0.2 * (p.y - 0.5), 0); }));
  const Camera sheared = make_camera("camera_texture:base=perspective,file=" + path("shear.pfm"), size);
  size_t seen = 0;
  for (double y = 5.5; y < 115; y += 7) {
    for (double x = 30.5; x < 130; x += 7) {
      const glm::dvec2 source(x - 0.2 * (y / 120.0 - 0.5) * 160.0, y);
      ASSERT_LT(glm::distance(sheared.unproject({x, y})->direction, base.unproject(source)->direction), on_grid);
      ++seen;
    }
  }
  EXPECT_GT(seen, 200U);
}

TEST_F(Deformation, AFoldedTextureShowsTheUnturnedSide) {
  // Screen x = x + 0.3 sin(2 pi x): turned over in the middle of the image.
  write_pfm(path("fold.pfm"), offsets({128, 4}, [](const glm::dvec2& p) {
              return glm::dvec2(0.3 * std::sin(2.0 * std::numbers::pi * p.x), 0.0);
            }));
  const WarpMesh mesh =
      texture_mesh({128, 4}, [&](const glm::dvec2& place, const glm::ivec2& texel, const glm::dvec2&) {
        const FloatImage image = read_vectors(path("fold.pfm"));
        return WarpNode{place + glm::dvec2(image.at(texel.x, texel.y)[0], 0.0), place};
      });
  size_t overlapping = 0;
  const auto sources = warp_sources(mesh, size, "fold", overlapping);
  EXPECT_GT(overlapping, sources.size() / 10);
  for (int x = 20; x < 140; ++x) {
    const double source = sources[60 * 160 + static_cast<size_t>(x)].x;
    const double slope = 1.0 + 0.6 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * source);
    const double place = source + 0.3 * std::sin(2.0 * std::numbers::pi * source);
    EXPECT_NEAR(place, (x + 0.5) / 160.0, 2e-3);
    EXPECT_GT(slope, -0.1) << x;
  }
}

TEST_F(Deformation, SequencesOfTexturesHaveAFrame) {
  write_pfm(path("o_0007.pfm"), offsets({3, 3}, [](const glm::dvec2&) { return glm::dvec2(0.0); }));
  const std::string text = "camera_texture:base=perspective,file=" + path("o_%04d.pfm");
  EXPECT_TRUE(changes_with_frame(text));
  EXPECT_FALSE(changes_with_frame(text_of_frame(text, 7)));
  expect_equal(make_camera(text_of_frame(text, 7), size), make_camera("perspective", size), on_grid);
  expect_refused(text, ErrorKind::command, {"frame is missing"});
  expect_refused(text_of_frame(text, 8), ErrorKind::input, {"o_0008.pfm"});
  expect_refused("camera_texture:base=perspective,frame=1,file=" + path("o_0007.pfm"), ErrorKind::command, {"%04d"});
}

TEST_F(Deformation, TexturesThatAreNoneAreRefused) {
  write_pfm(path("grey.pfm"), FloatImage({4, 4}, 1));
  expect_refused("camera_texture:base=perspective,file=" + path("grey.pfm"), ErrorKind::input, {"1 component"});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  write_pfm(path("nan.pfm"), FloatImage({4, 4}, 3, nan));
  expect_refused("camera_texture:base=perspective,file=" + path("nan.pfm"), ErrorKind::command, {"sees nothing"});
  write_pfm(path("huge.pfm"), FloatImage({4, 4}, 3, 1e30F));
  expect_refused("camera_texture:base=perspective,file=" + path("huge.pfm"), ErrorKind::command, {"sees nothing"});
  expect_refused("camera_texture:base=perspective,file=" + file("t.pfm", "PF\n9 9\n-1\n"), ErrorKind::input,
                 {"truncated"});
  expect_refused("camera_texture:file=" + path("nan.pfm"), ErrorKind::command, {"base is missing"});
  expect_refused("camera_texture:base=perspectiv,file=" + path("nan.pfm"), ErrorKind::command, {"'perspective'"});
  expect_refused("camera_texture:base=perspective,file=" + path("nan.pfm") + ",strenght=2", ErrorKind::command,
                 {"strenght"});
  expect_refused("camera_texture:base=camera_texture,file=" + path("nan.pfm"), ErrorKind::command, {"missing"});
}

std::string bourke_identity(int columns, int rows, double aspect) {
  std::string text = fmt::format("2\n{} {}\n", columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const double u = static_cast<double>(x) / (columns - 1), v = static_cast<double>(y) / (rows - 1);
      text += fmt::format("{} {} {} {} 1\n", (2.0 * u - 1.0) * aspect, 2.0 * v - 1.0, u, v);
    }
  }
  return text;
}

TEST_F(Deformation, AMeshThatMovesNothingLeavesTheBaseAsItIs) {
  const Camera base = make_camera("perspective:fov_deg=80", size);
  const std::string tail = ",base=perspective,fov_deg=80,base_width=160,base_height=120";
  expect_equal(make_camera("warp_mesh:file=" + file("i.data", bourke_identity(7, 5, 4.0 / 3.0)) + tail, size), base,
               on_grid);
  expect_equal(make_camera("warp_mesh:file=" +
                               file("i.obj",
                                    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                    "f 1/1/1 2/2 3 -1/-1\n") +
                               tail,
                           size),
               base, on_grid);
  write_pfm(path("i.pfm"), offsets({8, 6}, [](const glm::dvec2& p) { return glm::dvec2(p.x, 1.0 - p.y); }));
  const Camera from_pfm = make_camera("warp_mesh:file=" + path("i.pfm") + tail, size);
  expect_equal(from_pfm, base, on_grid);
  expect_equal(make_camera(to_text(from_pfm)), from_pfm);
}

TEST_F(Deformation, APolarMeshClosesAndANegativeIntensityIsAHole) {
  // Around the centre in 8 steps, radius 0.2 to 1, of a square image; u runs around, v outwards.
  std::string text = "1\n8 2\n", hole = text;
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < 8; ++i) {
      const double angle = i * std::numbers::pi / 4.0, radius = ring == 0 ? 0.2 : 1.0;
      const std::string node = fmt::format("{} {} {} {} ", radius * std::cos(angle), radius * std::sin(angle),
                                           0.5 + 0.5 * radius * std::cos(angle), 0.5 + 0.5 * radius * std::sin(angle));
      text += node + "1\n";
      hole += node + (i == 2 ? "-1\n" : "1\n");
    }
  }
  const ImageSize square{100, 100};
  const Camera base = make_camera("equidistant:fov_deg=180", square);
  const Camera ring = make_camera("warp_mesh:base=equidistant,fov_deg=180,file=" + file("p.data", text), square);
  for (int i = 0; i < 8; ++i) {  // between nodes, the last cell included
    const double angle = (i + 0.5) * std::numbers::pi / 4.0;
    const glm::dvec2 pixel(std::floor(50.0 + 30.0 * std::cos(angle)) + 0.5,
                           std::floor(50.0 - 30.0 * std::sin(angle)) + 0.5);
    ASSERT_TRUE(ring.unproject(pixel)) << i;
    EXPECT_LT(glm::distance(ring.unproject(pixel)->direction, base.unproject(pixel)->direction), 1e-6);
  }
  EXPECT_FALSE(ring.unproject({50.5, 50.5}));
  const Camera cut = make_camera("warp_mesh:base=equidistant,fov_deg=180,file=" + file("h.data", hole), square);
  EXPECT_FALSE(cut.unproject({50.5, 20.5}));
  EXPECT_TRUE(cut.unproject({50.5, 80.5}));
}

TEST_F(Deformation, MeshesThatAreNoneAreRefused) {
  const auto refused = [&](const std::string& name, const std::string& text, const std::vector<std::string>& parts) {
    expect_refused("warp_mesh:base=equidistant,file=" + file(name, text), ErrorKind::input, parts);
  };
  refused("m.data", "", {"header"});
  refused("m.data", "3\n2 2\n", {"m.data:1", "mesh type"});
  refused("m.data", "2\n1 9\n", {"m.data:2", "1 x 9"});
  refused("m.data", "2\n99999999999 9\n", {"m.data:2"});
  refused("m.data", "2\n4000000000 4000000000\n", {"m.data:2"});
  refused("m.data", "2\n-2 -2\n", {"m.data:2"});
  refused("m.data", "2\n2 2\n0 0 0 0 1\n", {"1 lines of nodes"});
  refused("m.data", "2\n2 2\n0 0 0 0 1\n0 0 0 0\n0 0 0 0 1\n0 0 0 0 1\n", {"m.data:4", "4 values"});
  refused("m.data", "2\n2 2\n0 0 0 0 1\n0 nan 0 0 1\n0 0 0 0 1\n0 0 0 0 1\n", {"m.data:4", "nan"});
  refused("m.obj", "v 0 0 0\n", {"no face"});
  refused("m.obj", "v 0 0 0\nvt 0 0\nf 1 1\n", {"m.obj:3", "2 corners"});
  refused("m.obj", "v 0 0 0\nvt 0 0\nf 1 1 2\n", {"m.obj:3", "no vertex 2"});
  refused("m.obj", "v 0 0 0\nvt 0 0\nf 0 1 1\n", {"m.obj:3"});
  refused("m.obj", "v 0 0 0\nvt 0 0\nf -2 1 1\n", {"m.obj:3"});
  refused("m.obj", "v 0 0 0\nvt 0 0\nf / 1 1\n", {"m.obj:3"});
  refused("m.obj", "v 0 0 0\nf 1 1 1\n", {"m.obj:2", "texture coordinate"});
  refused("m.obj", "v 0\n", {"m.obj:1"});
  expect_refused("warp_mesh:base=equidistant,file=" + file("m.txt", "x"), ErrorKind::command, {".data"});
  // The whole image a thousand times over must not take a thousand times as long.
  std::string layers = "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nvt 0 0\nvt 1 0\nvt 1 1\n";
  for (int i = 0; i < 1000; ++i) layers += "f 1 2 3\n";
  refused("m.obj", layers, {"times over"});
}

TEST_F(Deformation, ReadsMeshesOfDomes) {
  const std::filesystem::path folder = std::filesystem::path(places::shared_data) / "sgct";
  if (!std::filesystem::exists(folder / "standard_16x9.data")) GTEST_SKIP() << "no " << folder;
  const ImageSize screen{320, 180};
  const auto seen = [&](const char* name) {
    const Camera camera =
        make_camera("warp_mesh:base=equidistant,fov_deg=180,file=" + (folder / name).string(), screen);
    size_t count = 0;
    for (const glm::vec3& ray : rays_of(camera).directions) count += ray == glm::vec3(0.0F) ? 0 : 1;
    return static_cast<double>(count) / (320.0 * 180.0);
  };
  EXPECT_GT(seen("standard_16x9.data"), 0.4);
  EXPECT_GT(seen("bottom_warp2.obj"), 0.1);
  EXPECT_GT(seen("left_warp2.obj"), 0.02);
}

}  // namespace
}  // namespace omma
