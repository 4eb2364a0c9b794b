// The pieces that stand for a camera: within the tolerance, without a gap, the same on both sides of an edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "omma/base/error.h"
#include "omma/camera/deformation/warp.h"
#include "omma/camera/pieces/approximate.h"
#include "omma/camera/pieces/places.h"
#include "omma/camera/ray_bundle.h"
#include "tests/proof.h"

namespace omma {
namespace {

Camera sample(const LensModel& model) {
  const std::string name = model.info.name;
  if (model.info.max_fov_deg == 0) return make_camera(name + ":width=400,height=300");
  if (model.info.default_fov_deg > 0) return make_camera(name + ":width=400,height=300");
  return make_camera(model.info.example);
}

class EveryLensInPieces : public testing::TestWithParam<const LensModel*> {};

std::vector<const LensModel*> models_of_today() {
  std::vector<const LensModel*> models;
  for (size_t i = 0; i < lens_models().size(); ++i) {
    if (is_proved_today(i)) models.push_back(&lens_models()[i]);
  }
  return models;
}

INSTANTIATE_TEST_SUITE_P(Camera, EveryLensInPieces, testing::ValuesIn(models_of_today()),
                         [](const auto& lens) { return std::string(lens.param->info.name); });

// Lenses whose image ends where the world is stretched without bound or comes together in a point, or in a circle
// beyond which the formula says nothing: there pieces of two pixels, the smallest, are still too large.
const std::set<std::string_view> ends_abruptly = {"orthographic_fisheye",
                                                  "cylindrical_equal_area",
                                                  "sinusoidal",
                                                  "hammer",
                                                  "mollweide",
                                                  "winkel_tripel",
                                                  "albers",
                                                  "thoby",
                                                  "dual_fisheye"};

TEST_P(EveryLensInPieces, ArePiecesWithinTheToleranceThatCoverAllThatIsSeen) {
  const Camera camera = sample(*GetParam());
  const Approximation made = approximate(camera, {.tolerance_px = 0.25});
  RecordProperty("pieces", static_cast<int>(made.pieces.pieces().size()));
  RecordProperty("max_px", fmt::format("{:.3f}", made.error.max_px));
  EXPECT_GT(made.error.points, 1000U);
  if (ends_abruptly.contains(GetParam()->info.name)) {
    EXPECT_LT(made.error.p95_px, 0.25);
  } else {
    // What is measured lies between the points at which it was chosen.
    EXPECT_LT(made.error.max_px, 0.27) << made.error.worst.x << ", " << made.error.worst.y;
  }
  size_t seen = 0, uncovered = 0, twice = 0;
  for (int y = 0; y < camera.size().height; ++y) {
    for (int x = 0; x < camera.size().width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      if (!camera.unproject(pixel)) continue;
      ++seen;
      if (made.pieces.owner(pixel)) continue;
      ++uncovered;
      if (uncovered < 4) ADD_FAILURE() << x << ", " << y;
    }
  }
  for (uint32_t i = 0; i < made.pieces.pieces().size(); ++i) twice += made.pieces.contested(i);
  EXPECT_GT(seen, 10000U);
  EXPECT_EQ(uncovered, 0U);
  EXPECT_EQ(twice, 0U);
}

TEST_P(EveryLensInPieces, SeeTheSameOnBothSidesOfAnEdge) {
  const Approximation made = approximate(sample(*GetParam()), {.tolerance_px = 1.0});
  using Key = std::array<int64_t, 4>;
  std::map<Key, std::vector<uint32_t>> edges;
  for (uint32_t i = 0; i < made.pieces.pieces().size(); ++i) {
    const PolygonOnGrid polygon(made.pieces.pieces()[i]);
    for (int corner = 0; corner < polygon.count; ++corner) {
      glm::i64vec2 a = polygon.at(corner), b = polygon.at(corner + 1);
      if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
      edges[{a.x, a.y, b.x, b.y}].push_back(i);
    }
  }
  // Layouts have edges at which the world jumps; else neighbours see the same ray as long, so depth goes on, too.
  const bool layout = std::string_view(GetParam()->info.group) == "layout";
  size_t shared = 0, equal = 0;
  double worst = 0.0;
  for (const auto& [key, pieces] : edges) {
    ASSERT_LE(pieces.size(), 2U);
    if (pieces.size() < 2) continue;
    ++shared;
    double apart = 0.0;
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
      const glm::dvec2 pixel = glm::mix(glm::dvec2(key[0], key[1]), glm::dvec2(key[2], key[3]), t) / 256.0;
      const glm::dvec3 a = made.pieces.rayFromImage(pieces[0]) * glm::dvec3(pixel, 1.0);
      const glm::dvec3 b = made.pieces.rayFromImage(pieces[1]) * glm::dvec3(pixel, 1.0);
      apart = std::max(apart, glm::distance(a, b) / glm::length(a));
    }
    equal += apart < 1e-5;
    worst = std::max(worst, apart);
  }
  RecordProperty("worst", fmt::format("{:.2g}", worst));
  if (layout) {
    EXPECT_TRUE(equal * 2 >= shared || made.layout == "exact");
  } else {
    // Along the arcs that are the poles of a conic all three corners of a piece can have nearly one ray; it is then
    // made from rays within.
    if (GetParam()->info.name == std::string_view("albers")) {
      EXPECT_GT(equal, 0.99 * static_cast<double>(shared));
    } else {
      EXPECT_LT(worst, 1e-5);
    }
    EXPECT_TRUE(shared > 2 || made.pieces.pieces().size() <= 3);
  }
}

TEST(Approximation, WhatIsPerspectiveByNatureIsExact) {
  for (const auto& [text, count] : {std::pair("perspective:fov_deg=100", 1), std::pair("cube_3x2", 6),
                                    std::pair("cube_6x1", 6), std::pair("cube_1x6", 6), std::pair("octahedral", 8),
                                    std::pair("tetrahedral", 4), std::pair("biplane", 2), std::pair("triplane", 3)}) {
    for (const ImageSize size : {ImageSize{600, 400}, ImageSize{333, 257}}) {
      const Camera camera = make_camera(text, size);
      const Approximation made = approximate(camera);
      EXPECT_EQ(made.pieces.pieces().size(), static_cast<size_t>(count)) << text;
      EXPECT_EQ(made.layout, "exact") << text;
      EXPECT_LT(made.error.mean_px, 1e-6) << text;
      // Where a corner was rounded, the neighbour's side of an edge begins a little earlier or later.
      EXPECT_LT(made.error.max_px, 2.0 / piece_grid + 1e-6) << text;
    }
  }
}

TEST(Approximation, CylindersAreStrips) {
  const Camera camera = make_camera("cylinder:fov_deg=360", ImageSize{1600, 1200});
  const Approximation fewest = approximate(camera);
  EXPECT_EQ(fewest.layout, "strips");
  EXPECT_LT(fewest.pieces.pieces().size(), 120U);
  const Approximation equal = approximate(camera, {.count = 160});
  EXPECT_EQ(equal.layout, "strips");
  ASSERT_EQ(equal.pieces.pieces().size(), 160U);
  for (const Piece& piece : equal.pieces.pieces()) {
    EXPECT_EQ(piece.corner_count, 4);
    EXPECT_EQ(piece.corners[1] - piece.corners[0], glm::dvec2(10.0, 0.0));
    EXPECT_EQ(piece.corners[2] - piece.corners[1], glm::dvec2(0.0, 1200.0));
  }
  // Between a strip's edges a plane shows the ends of an upright line short: 600 px (1 - cos(half a strip)).
  EXPECT_NEAR(equal.error.max_px, 600.0 * (1.0 - std::cos(3.14159265358979 / 160.0)), 0.01);
  EXPECT_EQ(approximate(make_camera("panini", ImageSize{400, 300})).layout, "strips");
}

TEST(Approximation, ACountIsKept) {
  for (const char* text : {"equidistant:fov_deg=180", "hammer", "eac"}) {
    for (const int count : {50, 1000}) {
      const size_t made = approximate(make_camera(text, ImageSize{400, 300}), {.count = count}).pieces.pieces().size();
      EXPECT_GT(made, static_cast<size_t>(0.5 * count)) << text;
      EXPECT_LT(made, static_cast<size_t>(1.1 * count + 8)) << text;
    }
  }
}

TEST(Approximation, RayMapsAndPiecesHaveOneToo) {
  const Camera lens = make_camera("equidistant:fov_deg=150,fit=full", ImageSize{200, 150});
  const Camera map(rays_of(lens));
  const Approximation of_map = approximate(map, {.tolerance_px = 0.5});
  EXPECT_LT(of_map.error.max_px, 0.55);
  EXPECT_LT(measure_pieces(of_map.pieces, lens).p95_px, 0.5);
  const Camera pieces(of_map.pieces);
  EXPECT_EQ(approximate(pieces).pieces, of_map.pieces);
  EXPECT_LT(approximate(pieces).error.max_px, 1e-6);
  const Approximation merged = approximate(pieces, {.tolerance_px = 4.0});
  EXPECT_LT(merged.pieces.pieces().size(), of_map.pieces.pieces().size());
}

TEST(Approximation, OptionsOutOfRangeAreRefused) {
  const Camera camera = make_camera("equidistant", ImageSize{40, 30});
  EXPECT_THROW(approximate(camera, {.tolerance_px = 0.001}), CommandError);
  EXPECT_THROW(approximate(camera, {.tolerance_px = std::nan("")}), CommandError);
  EXPECT_THROW(approximate(camera, {.count = -1}), CommandError);
}

TEST(Approximation, ACameraTextureIsItsGridsTriangles) {
  const WarpMesh mesh = texture_mesh({80, 60}, [](const glm::dvec2& place, const glm::ivec2&, const glm::dvec2&) {
    const glm::dvec2 wave(std::sin(9.0 * place.y), std::cos(7.0 * place.x));
    return WarpNode{place + 0.02 * place * (1.0 - place) * wave, place};
  });
  const Camera base = make_camera("perspective:fov_deg=90", ImageSize{1600, 1200});
  const auto pieces = warped_pieces(mesh, base, base.size(), "texture");
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->pieces().size(), 9322U);
  size_t uncovered = 0;
  double worst = 0.0;
  for (int y = 0; y < 1200; y += 3) {
    for (int x = 0; x < 1600; x += 3) {
      const auto ray = pieces->unproject({x + 0.5, y + 0.5});
      uncovered += !ray;
      if (!ray) continue;
      // The source that is moved here, by a few steps of a fixed point.
      glm::dvec2 place = glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(1600, 1200), source = place;
      for (int i = 0; i < 30; ++i) {
        const glm::dvec2 wave(std::sin(9.0 * source.y), std::cos(7.0 * source.x));
        source = place - 0.02 * source * (1.0 - source) * wave;
      }
      worst = std::max(worst, glm::distance(*base.project(*ray), source * glm::dvec2(1600, 1200)));
    }
  }
  EXPECT_EQ(uncovered, 0U);
  EXPECT_LT(worst, 0.2);  // what lies between the texels
  EXPECT_FALSE(warped_pieces(mesh, make_camera("equidistant", ImageSize{1600, 1200}), {1600, 1200}, "texture"));
}

}  // namespace
}  // namespace omma
