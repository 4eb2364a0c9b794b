// Layouts: where the parts of the world lie, and that all of it is there.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "omma/camera/camera.h"
#include "tests/unit/camera_directions.h"

namespace omma {
namespace {

// A direction (x right, y up, z behind) and where in an image of 100 by 100 parts of a percent it lies.
struct Place {
  glm::dvec3 direction;
  glm::dvec2 percent;
};

const std::map<std::string, std::vector<Place>> places = {
    // right, left, up / down, front, back
    {"cube_3x2",
     {{{1, 0, 0}, {100 / 6.0, 25}},
      {{-1, 0, 0}, {50, 25}},
      {{0, 1, 0}, {500 / 6.0, 25}},
      {{0, -1, 0}, {100 / 6.0, 75}},
      {{0, 0, -1}, {50, 75}},
      {{0, 0, 1}, {500 / 6.0, 75}},
      {{0.5, 0.5, -1}, {350 / 6.0, 62.5}},
      {{1, 0.5, 0.5}, {150 / 6.0, 12.5}},
      {{0.5, 1, -0.5}, {550 / 6.0, 37.5}}}},
    {"cube_6x1",
     {{{1, 0, 0}, {100 / 12.0, 50}},
      {{0, 0, -1}, {900 / 12.0, 50}},
      {{0, 0, 1}, {1100 / 12.0, 50}},
      {{0.5, 0.25, 1}, {1050 / 12.0, 37.5}}}},
    {"cube_1x6", {{{-1, 0, 0}, {50, 25}}, {{0, 1, 0}, {50, 500 / 12.0}}, {{0, -1, 0.5}, {50, 750 / 12.0}}}},
    // left, front, right / down, back, up; at 45 degrees a quarter of a face is half its pixels
    {"eac",
     {{{-1, 0, 0}, {100 / 6.0, 25}},
      {{0, 0, -1}, {50, 25}},
      {{1, 0, 0}, {500 / 6.0, 25}},
      {{0, -1, 0}, {100 / 6.0, 75}},
      {{0, 0, 1}, {50, 75}},
      {{0, 1, 0}, {500 / 6.0, 75}},
      {{std::tan(pi / 8), 0, -1}, {350 / 6.0, 25}},
      // The middle row of faces is continuous below, too: the nadir's far edge meets the back face.
      {{0, -1, 0.999999999}, {200 / 6.0, 75}},
      {{0, -0.999999999, 1}, {200 / 6.0, 75}},
      {{0, 1, 0.999999999}, {400 / 6.0, 75}}}},
    {"octahedral",
     {{{0, 0, -1}, {50, 50}},
      {{1, 0, 0}, {100, 50}},
      {{0, 1, 0}, {50, 0}},
      {{1, 1, -1}, {100 * 4 / 6.0, 100 * 2 / 6.0}},
      {{1, 1, 1}, {100 * 5 / 6.0, 100 / 6.0}}}},
    // pbrt: z = 1 - r² at the distance r = |x| + |y| from the middle
    {"octahedral_equal_area",
     {{{0, 0, -1}, {50, 50}},
      {{1, 0, 0}, {100, 50}},
      {{0, -1, 0}, {50, 100}},
      {{std::sqrt(1.75 * 0.25), 0, -0.75}, {75, 50}},
      {{std::sqrt(0.5 * 1.75 * 0.25), std::sqrt(0.5 * 1.75 * 0.25), -0.75}, {62.5, 37.5}},
      {{std::sqrt(0.5 * 1.75 * 0.25), std::sqrt(0.5 * 1.75 * 0.25), 0.75}, {87.5, 12.5}}}},
    {"tetrahedral", {{{1, 1, 1}, {50, 100}}, {{1, -1, -1}, {50, 0}}, {{-1, 1, -1}, {0, 100}}, {{1, 0, 0}, {50, 50}}}},
    // scale 0.99 of 80 percent by 100 percent, and of 20 percent by 50 percent
    {"barrel",
     {{{0, 0, -1}, {40, 50}},
      {{1, 0, 0}, {40 + 20 * 0.99, 50}},
      {{0, 1, -1.0000001}, {40, 50 - 50 * 0.99}},
      {{0, 1, 0}, {90, 25}},
      {{0, -1, 0}, {90, 75}},
      {{0.5, 1, 0}, {90 + 5 * 0.99, 25}},
      {{0, 1, -0.5}, {90, 25 + 12.5 * 0.99}}}},
    // front above back; front zenith, front nadir, back zenith, back nadir
    {"barrelsplit",
     {{{0, 0, -1}, {100 / 3.0, 25}},
      {{0, 0, 1}, {100 / 3.0, 75}},
      {{1, 0, -1}, {50, 25}},
      {{1, 0, 1}, {50 / 3.0, 75}},
      {{0, 1, -0.5}, {250 / 3.0, 12.5}},
      {{0.5, 1, -0.25}, {275 / 3.0, 6.25}},
      {{0.5, -1, 0.25}, {75, 93.75}}}},
    {"pyramid",
     {{{0, 0, -1}, {25, 50}},
      {{0.5, 0.5, -1}, {37.5, 25}},
      {{0, 0, 1}, {75, 50}},
      {{1, 0, 0}, {75 - 25 * 0.625, 50}},
      {{-1, 0, 0}, {75 + 25 * 0.625, 50}},
      {{0, 1, 0}, {75, 50 - 50 * 0.625}}}},
    {"dual_fisheye",
     {{{0, 0, -1}, {75, 50}},
      {{0, 0, 1}, {25, 50}},
      {{1, 0, -1}, {87.5, 50}},
      {{1, 0, 1}, {12.5, 50}},
      {{0, 1, 1}, {25, 25}}}},
};

class EveryLayout : public testing::TestWithParam<const LensModel*> {};

INSTANTIATE_TEST_SUITE_P(Camera, EveryLayout, testing::ValuesIn(models_of("layout")),
                         [](const auto& lens) { return std::string(lens.param->info.name); });

TEST_P(EveryLayout, HasItsPartsWhereTheFormatSays) {
  const LensModel& model = *GetParam();
  const auto found = places.find(model.info.name);
  ASSERT_NE(found, places.end()) << "say where directions lie in this layout";
  // Whatever the image's shape.
  for (const ImageSize size : {ImageSize{600, 400}, ImageSize{300, 700}}) {
    const Camera camera = make_camera(model.info.name, size);
    for (const Place& place : found->second) {
      const glm::dvec2 expected = place.percent * 0.01 * glm::dvec2(size.width, size.height);
      const auto pixel = camera.project(place.direction);
      ASSERT_TRUE(pixel);
      EXPECT_LT(glm::distance(*pixel, expected), 1e-4)
          << pixel->x << ", " << pixel->y << " instead of " << expected.x << ", " << expected.y;
    }
  }
}

TEST_P(EveryLayout, FillsTheImageAndShowsTheWholeSphere) {
  const LensModel& model = *GetParam();
  const Camera camera = make_camera(model.info.name, ImageSize{210, 123});
  size_t seen = 0;
  for (int y = 0; y < 123; ++y) {
    for (int x = 0; x < 210; ++x) seen += camera.unproject({x + 0.5, y + 0.5}).has_value();
  }
  // Circles leave the corners.
  const double share = std::string_view(model.info.name) == "dual_fisheye" ? pi / 4 : 1.0;
  EXPECT_NEAR(static_cast<double>(seen), share * 210 * 123, share == 1.0 ? 0.0 : 100.0);
  for (int i = 0; i < 5000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 5000.0, rho = std::sqrt(1.0 - z * z), turn = 2.399963 * i;
    const glm::dvec3 direction(rho * std::cos(turn), rho * std::sin(turn), z);
    const auto pixel = camera.project(direction);
    ASSERT_TRUE(pixel) << i;
    ASSERT_TRUE(pixel->x >= -1e-9 && pixel->x <= 210 + 1e-9 && pixel->y >= -1e-9 && pixel->y <= 123 + 1e-9) << i;
    const auto back = camera.unproject(*pixel);
    ASSERT_TRUE(back) << i;
    EXPECT_LT(glm::distance(back->direction, direction), 1e-12) << i;
  }
}

TEST(Layouts, GiveEqualSolidAnglesEqualAreasWhereTheySaySo) {
  const LensModel& model = *find_lens_model("octahedral_equal_area");
  const LensParameters parameters = lens_parameters(model.info);
  for (int i = 0; i < 500; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 500.0, turn = 2.399963 * i;
    const auto [east, north] = scales(model, parameters, turn * 180 / pi, std::asin(z) * 180 / pi);
    // Four units of area for 4π of solid angle.
    const double area = std::abs(east.x * north.y - east.y * north.x);
    if (glm::length(east) > 10 || glm::length(north) > 10) continue;  // the difference spans a fold
    EXPECT_NEAR(area, 1 / pi, 1e-6) << i;
  }
}

TEST(DualFisheye, OverlapsBeyondAHemisphereAndHasGapsBelow) {
  const Camera wide = make_camera("dual_fisheye:circle_fov_deg=200", ImageSize{400, 200});
  // Ten degrees behind the left and right are at the edge of the front circle as well.
  EXPECT_NEAR(wide.unproject({399.999, 100})->direction.z, std::sin(radians(10)), 1e-4);
  EXPECT_LT(wide.project({1, 0, 0.1})->x, 200.0);
  const Camera narrow = make_camera("dual_fisheye:circle_fov_deg=160", ImageSize{400, 200});
  EXPECT_FALSE(narrow.project({1, 0, 0}));
  EXPECT_TRUE(narrow.project(direction_at(79, 0)));
  EXPECT_TRUE(narrow.project(direction_at(101, 0)));
}

}  // namespace
}  // namespace omma
