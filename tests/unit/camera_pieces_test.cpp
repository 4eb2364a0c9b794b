// Cameras in the pieces form: whose each place is, rays and pixels, files, what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/camera/camera.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/ray_bundle.h"

namespace omma {
namespace {

constexpr double grid = piece_grid;

glm::dvec2 snapped(const glm::dvec2& pixel) { return glm::round(pixel * grid) / grid; }

// What a pinhole of this focal length shows, its axis at the centre.
glm::dmat3 pinhole(double focal, const glm::dvec2& centre) {
  return {{focal, 0, 0}, {0, -focal, 0}, {-centre.x, -centre.y, -1}};
}

Piece polygon(std::initializer_list<glm::dvec2> corners, const glm::dmat3& matrix = pinhole(100, {50, 50})) {
  Piece piece;
  piece.corner_count = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), piece.corners.begin());
  piece.imageFromRay = matrix;
  return piece;
}

// A mesh of cells whose inner nodes are moved at random; each cell is a quad where it is convex, else two triangles.
std::vector<Piece> random_mesh(std::mt19937& random, int columns, int rows, double side, bool only_triangles) {
  std::uniform_real_distribution<double> move(-0.45 * side, 0.45 * side);
  std::vector<glm::dvec2> nodes;
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const bool inner_x = x > 0 && x<columns, inner_y = y> 0 && y < rows;
      nodes.push_back(snapped({x * side + (inner_x ? move(random) : 0.0), y * side + (inner_y ? move(random) : 0.0)}));
    }
  }
  std::vector<Piece> pieces;
  const auto turn = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
  };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const auto node = [&](int dx, int dy) { return nodes[static_cast<size_t>((y + dy) * (columns + 1) + x + dx)]; };
      const glm::dvec2 a = node(0, 0), b = node(1, 0), c = node(1, 1), d = node(0, 1);
      const bool at_a = turn(d, a, b) > 0, at_b = turn(a, b, c) > 0, at_c = turn(b, c, d) > 0, at_d = turn(c, d, a) > 0;
      if (!only_triangles && at_a && at_b && at_c && at_d) {
        pieces.push_back(polygon({a, b, c, d}));
      } else if (turn(a, b, c) > 0 && turn(a, c, d) > 0) {
        pieces.push_back(polygon({a, b, c}));
        pieces.push_back(polygon({a, c, d}));
      } else {
        pieces.push_back(polygon({a, b, d}));
        pieces.push_back(polygon({b, c, d}));
      }
    }
  }
  return pieces;
}

size_t owners(const std::vector<Piece>& pieces, const glm::i64vec2& place) {
  size_t count = 0;
  for (const Piece& piece : pieces) count += owns(piece, place);
  return count;
}

TEST(Pieces, EveryPlaceOfAMeshHasExactlyOneOwner) {
  std::mt19937 random(7);
  size_t places = 0;
  for (int mesh = 0; mesh < 60; ++mesh) {
    const int columns = 2 + mesh % 5, rows = 1 + mesh % 7;
    const double side = mesh % 3 == 0 ? 0.125 : 9.0;  // also where places are few and nearly all on edges
    const std::vector<Piece> pieces = random_mesh(random, columns, rows, side, mesh % 2 == 0);
    const glm::i64vec2 end = on_piece_grid(glm::dvec2(columns, rows) * side);
    const auto check = [&](const glm::i64vec2& place) {
      const bool inside = place.x >= 0 && place.y >= 0 && place.x < end.x && place.y < end.y;
      ASSERT_EQ(owners(pieces, place), inside ? 1U : 0U) << mesh << ": " << place.x << ", " << place.y;
      places += inside;
    };
    for (const Piece& piece : pieces) {
      for (int i = 0; i < piece.corner_count; ++i) {
        const glm::i64vec2 a = on_piece_grid(piece.corners[static_cast<size_t>(i)]);
        const glm::i64vec2 b = on_piece_grid(piece.corners[static_cast<size_t>((i + 1) % piece.corner_count)]);
        check(a);
        for (int t = 1; t < 16; ++t) check(a + (b - a) * int64_t{t} / int64_t{16});
      }
    }
    std::uniform_int_distribution<int64_t> x(-3, end.x + 3), y(-3, end.y + 3);
    for (int i = 0; i < 2000; ++i) check({x(random), y(random)});
  }
  EXPECT_GT(places, 100000U);
}

TEST(Pieces, ManyAroundOneCornerAndTJunctionsLeaveNoHole) {
  std::mt19937 random(11);
  // A fan of thin triangles around a point: on it all of them meet.
  const glm::dvec2 middle(40.25, 30.125);
  std::vector<Piece> fan;
  constexpr int blades = 97;
  for (int i = 0; i < blades; ++i) {
    const auto rim = [&](int blade) {
      const double angle = 2.0 * 3.14159265358979 * (blade % blades) / blades;
      return snapped(middle + 25.0 * glm::dvec2(std::cos(angle), std::sin(angle)));
    };
    fan.push_back(polygon({middle, rim(i), rim(i + 1)}));
  }
  std::uniform_int_distribution<int64_t> near(-300, 300);
  EXPECT_EQ(owners(fan, on_piece_grid(middle)), 1U);
  for (int i = 0; i < 20000; ++i) {
    ASSERT_EQ(owners(fan, on_piece_grid(middle) + glm::i64vec2(near(random), near(random))), 1U);
  }
  // Large cells beside small ones: corners lie on the edges of others.
  std::vector<Piece> tiles = {polygon({{0, 0}, {8, 0}, {8, 16}, {0, 16}}), polygon({{8, 0}, {16, 0}, {16, 5}, {8, 5}}),
                              polygon({{8, 5}, {16, 5}, {16, 16}}), polygon({{8, 5}, {16, 16}, {8, 16}})};
  for (int64_t y = 0; y < 16 * piece_grid; y += 16) {
    for (int64_t x = 0; x < 16 * piece_grid; x += 16) ASSERT_EQ(owners(tiles, {x, y}), 1U) << x << ", " << y;
  }
}

TEST(Pieces, TheOwnerFoundThroughBinsIsTheFirstThatOwnsThePlace) {
  std::mt19937 random(3);
  std::vector<Piece> pieces = random_mesh(random, 9, 7, 20.0, false);
  const size_t mesh = pieces.size();
  // Two that lie over the mesh, partly outside of the image: the later one is seen nowhere that the mesh is.
  pieces.insert(pieces.begin(), polygon({{-30, 40}, {70, 20.5}, {60, 90}, {10, 100}}));
  pieces.push_back(polygon({{100, 100}, {300, 110}, {120, 190}}));
  const PieceSet set({180, 140}, pieces);
  std::uniform_real_distribution<double> x(-31.0, 211.0), y(-31.0, 171.0);
  size_t seen = 0;
  for (int i = 0; i < 50000; ++i) {
    const glm::dvec2 point(x(random), y(random));
    std::optional<uint32_t> expected;
    for (uint32_t p = 0; p < pieces.size() && !expected; ++p) {
      if (owns(pieces[p], on_piece_grid(point))) expected = p;
    }
    ASSERT_EQ(set.owner(point), expected) << point.x << ", " << point.y;
    seen += expected.has_value();
  }
  EXPECT_GT(seen, 25000U);
  EXPECT_FALSE(set.contested(0));
  EXPECT_TRUE(set.contested(static_cast<uint32_t>(pieces.size() - 1)));
  size_t contested = 0;
  for (uint32_t p = 1; p <= mesh; ++p) {
    // By places: none at all where it is not contested.
    bool both = false;
    for (int64_t gy = 0; gy < 140; ++gy) {
      for (int64_t gx = 0; gx < 180; ++gx) {
        const glm::i64vec2 place(gx * piece_grid, gy * piece_grid);
        both = both || (owns(pieces[0], place) && owns(pieces[p], place));
      }
    }
    EXPECT_TRUE(!both || set.contested(p)) << p;
    contested += set.contested(p);
  }
  EXPECT_GT(contested, 5U);
  EXPECT_LT(contested, mesh / 2);
  EXPECT_FALSE(set.owner({std::numeric_limits<double>::quiet_NaN(), 0.0}));
  EXPECT_FALSE(set.owner({1e300, -1e300}));
}

TEST(Pieces, OfAPinholeShowWhatThePinholeShows) {
  const Camera lens = make_camera("perspective:f=100,cx=50,cy=50,width=100,height=80");
  std::mt19937 random(5);
  const Camera pieces(PieceSet({100, 80}, random_mesh(random, 5, 4, 20.0, false)));
  EXPECT_EQ(pieces.lens(), nullptr);
  EXPECT_EQ(pieces.ray_map(), nullptr);
  ASSERT_NE(pieces.pieces(), nullptr);
  EXPECT_EQ(pieces.size(), lens.size());
  EXPECT_NEAR(pieces.pixels_per_radian(), lens.pixels_per_radian(), 1e-6);
  std::uniform_real_distribution<double> x(0.0, 100.0), y(0.0, 80.0);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec2 pixel = i == 0   ? glm::dvec2(100.0, 80.0)
                             : i == 1 ? glm::dvec2(0.0)
                                      : glm::dvec2(x(random), y(random));
    const auto ray = pieces.unproject(pixel);
    ASSERT_TRUE(ray) << pixel.x << ", " << pixel.y;
    ASSERT_LT(glm::distance(ray->direction, lens.unproject(pixel)->direction), 1e-13);
    const auto back = pieces.project(3.0 * ray->direction);
    ASSERT_TRUE(back) << pixel.x << ", " << pixel.y;
    ASSERT_LT(glm::distance(*back, pixel), 1e-11);
    EXPECT_FALSE(pieces.project(-ray->direction));
  }
  EXPECT_FALSE(pieces.project({0, 0, 0}));
  EXPECT_FALSE(pieces.unproject({101.0, 10.0}));
  const RayMap a = rays_of(pieces), b = rays_of(lens);
  ASSERT_EQ(a.directions.size(), b.directions.size());
  for (size_t i = 0; i < a.directions.size(); ++i) ASSERT_LT(glm::distance(a.directions[i], b.directions[i]), 1e-6F);
  EXPECT_THROW(to_text(pieces), CommandError);
}

class PiecesFile : public testing::Test {
 protected:
  PiecesFile() { std::filesystem::create_directories(folder_); }
  ~PiecesFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / fmt::format("omma_pieces_{}", ::getpid());
};

TEST_F(PiecesFile, WhatIsWrittenIsReadAsTheSamePieces) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Piece> pieces = random_mesh(random, 12, 9, 7.0, false);
  for (Piece& piece : pieces) {
    for (int i = 0; i < 3; ++i) piece.imageFromRay[i] += glm::dvec3(any(random), any(random), 0.01 * any(random));
  }
  const PieceSet set({84, 63}, pieces);
  const NamedCamera named{"pieces", Camera(set)};
  write_camera_file(path("p.json"), {&named, 1}, "pieces");
  const Camera read = make_camera(path("p.json"));
  ASSERT_NE(read.pieces(), nullptr);
  EXPECT_EQ(read.pieces()->pieces(), set.pieces());
  EXPECT_EQ(read.size(), set.size());
  EXPECT_EQ(read.pieces()->source(), path("p.json"));
  EXPECT_EQ(to_text(read), path("p.json"));
  EXPECT_EQ(make_camera(to_text(read), set.size()).pieces()->pieces(), set.pieces());
  EXPECT_THROW(make_camera(path("p.json"), ImageSize{168, 126}), CommandError);
  const NamedCamera lens{"lens", make_camera("equidistant")};
  EXPECT_THROW(write_camera_file(path("q.json"), {&lens, 1}, "pieces"), CommandError);
  EXPECT_THROW(write_camera_file(path("q.json"), {&named, 1}, "nerfstudio"), CommandError);
}

void expect_refused(const std::function<void()>& action, ErrorKind kind, const std::vector<std::string>& parts) {
  try {
    action();
    FAIL() << "accepted; expected: " << parts.front();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    const std::string message = error.what();
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Pieces, ThatAreNoneAreRefused) {
  const Piece good = polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  const auto refused = [&](const Piece& bad, const std::vector<std::string>& parts) {
    expect_refused([&] { PieceSet({20, 20}, {good, bad}, "x.json"); }, ErrorKind::command, parts);
  };
  refused(polygon({{0, 0}, {0, 10}, {10, 10}, {10, 0}}), {"x.json: pieces[1]", "clockwise"});
  refused(polygon({{0, 0}, {10, 0}, {0, 10}, {10, 10}}), {"convex"});
  refused(polygon({{0, 0}, {10, 0}, {2, 2}, {0, 10}}), {"convex"});
  refused(polygon({{0, 0}, {10, 0}, {20, 0}}), {"convex"});
  refused(polygon({{0, 0}, {5, 0}, {10, 0}, {0, 10}}), {"convex"});
  refused(polygon({{0, 0}, {10, 0.001}, {10, 10}, {0, 10}}), {"pieces[1]", "1/256"});
  refused(polygon({{0, 0}, {131073, 0}, {10, 10}}), {"131072"});
  refused(polygon({{0, 0}, {std::nan(""), 0}, {10, 10}}), {"131072"});
  Piece five = good;
  five.corner_count = 5;
  refused(five, {"5 corners"});
  for (const double value : {0.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    refused(polygon({{0, 0}, {10, 0}, {10, 10}}, glm::dmat3(value)), {"pieces[1].imageFromRay", "singular"});
  }
  refused(polygon({{0, 0}, {10, 0}, {10, 10}}, glm::dmat3({1, 2, 3}, {2, 4, 6}, {0, 1, 0})), {"singular"});
  expect_refused([] { PieceSet({20, 20}, {}); }, ErrorKind::command, {"none"});
  expect_refused([&] { PieceSet({0, 20}, {good}); }, ErrorKind::command, {"0 x 20"});
  const Piece all = polygon({{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}});
  expect_refused(
      [&] {
        PieceSet({2000, 2000}, std::vector<Piece>(1000, all), "many");
      },
      ErrorKind::command, {"many: ", "times over"});
}

TEST(Pieces, FilesThatHoldNoneAreRefusedWithLineAndKey) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_refused([&] { CameraFile::parse("p.json", text).camera(); }, ErrorKind::input, parts);
  };
  const std::string matrix = R"("imageFromRay":[[9,0,0],[0,9,0],[0,0,1]])";
  refused("{\"pieces\":[]}", {"p.json", "size"});
  refused("{\"size\":[4,4],\"pieces\":[]}", {"p.json", "none"});
  refused("{\"size\":[4,4],\"pieces\":7}", {"pieces", "list"});
  refused("{\"size\":[4],\"pieces\":[]}", {"size"});
  refused("{\"size\":[4,4],\"pieces\":[\n{" + matrix + "}]}", {"p.json:2", "pieces[0]", "corners"});
  refused("{\"size\":[4,4],\"pieces\":[{\"corners\":[[0,0],[4,0]]," + matrix + "}]}",
          {"pieces[0].corners", "2 corners"});
  refused("{\"size\":[4,4],\"pieces\":[{\"corners\":[[0,0],[4,0],[4]]," + matrix + "}]}", {"pieces[0].corners[2]"});
  refused("{\"size\":[4,4],\"pieces\":[{\"corners\":[[0,0],[4,0],[4,\"x\"]]," + matrix + "}]}", {"corners[2][1]"});
  refused("{\"size\":[4,4],\"pieces\":[{\"corners\":[[0,0],[4,0],[4,4]],\"imageFromRay\":[[1,0,0],[0,1,0]]}]}",
          {"pieces[0].imageFromRay", "3"});
  refused("{\"size\":[4,4],\"pieces\":[{\"corners\":[[0,0],[4,4],[4,0]]," + matrix + "}]}", {"pieces[0]", "clockwise"});
  refused("{\"size\":[4,4],\"pieces\":[{\"corners\":[[10,10],[20,10],[20,20]]," + matrix + "}]}", {"sees nothing"});
}

}  // namespace
}  // namespace omma
