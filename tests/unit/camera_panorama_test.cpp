// Panoramas and layouts: values worked out from the published formulae, what each projection preserves, where the parts
// of a layout lie.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "omma/camera/camera.h"

namespace omma {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radians(double deg) { return deg * pi / 180.0; }

// In the camera frame.
glm::dvec3 direction_at(double longitude_deg, double latitude_deg) {
  const double a = radians(longitude_deg), b = radians(latitude_deg);
  return {std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b)};
}

glm::dvec3 optical(const glm::dvec3& camera) { return {camera.x, -camera.y, -camera.z}; }

std::vector<const LensModel*> models_of(const char* group) {
  std::vector<const LensModel*> models;
  for (const LensModel& model : lens_models()) {
    if (std::string_view(model.info.group) == group) models.push_back(&model);
  }
  return models;
}

// As in an atlas: longitude to the right and latitude up in degrees, x to the right and y up in focal lengths.
struct MapPoint {
  double longitude_deg, latitude_deg, x, y;
};

struct MapValues {
  std::vector<double> parameters;
  std::array<MapPoint, 5> points;
};

// Worked out in 40 digits from the formulae as Snyder prints them (cos, asin and Newton's method on 2t + sin 2t), which
// differ from those in the lens files; panini from the paper, its squeezes and compression from Hugin's documentation.
const std::map<std::string, MapValues> map_values = {
    {"cylinder",
     {{},
      {{{30, 45, 0.52359877559829887, 1.0},
        {-75, 20, -1.3089969389957472, 0.36397023426620236},
        {60, -50, 1.0471975511965977, -1.19175359259421},
        {-20, -85, -0.34906585039886592, -11.430052302761343},
        {10, 5, 0.17453292519943296, 0.087488663525924005}}}}},
    {"equirectangular",
     {{},
      {{{30, 45, 0.52359877559829887, 0.78539816339744831},
        {-75, 20, -1.3089969389957472, 0.34906585039886592},
        {60, -50, 1.0471975511965977, -0.87266462599716479},
        {-20, -85, -0.34906585039886592, -1.4835298641951801},
        {10, 5, 0.17453292519943296, 0.087266462599716479}}}}},
    {"cylindrical_equal_area",
     {{37.5},
      {{{30, 45, 0.41539883759331128, 0.89128859144523542},
        {-75, 20, -1.0384970939832782, 0.43110695569784231},
        {60, -50, 0.83079767518662257, -0.96557788845732697},
        {-20, -85, -0.27693255839554086, -1.2556759359279291},
        {10, 5, 0.13846627919777043, 0.1098574094559983}}}}},
    {"mercator",
     {{},
      {{{30, 45, 0.52359877559829887, 0.88137358701954303},
        {-75, 20, -1.3089969389957472, 0.35637850472444999},
        {60, -50, 1.0471975511965977, -1.0106831886830213},
        {-20, -85, -0.34906585039886592, -3.131301331471645},
        {10, 5, 0.17453292519943296, 0.087377435962033558}}}}},
    {"transverse_mercator",
     {{},
      {{{30, 45, 0.36949897192586931, 0.85707194785013099},
        {-75, 20, -1.5141535227686723, 0.95265982430600921},
        {60, -50, 0.62799547328870765, -1.1735510764807833},
        {-20, -85, -0.029817853546008664, -1.4887683493111925},
        {10, 5, 0.17474458184177037, 0.088605706383845419}}}}},
    {"miller",
     {{},
      {{{30, 45, 0.52359877559829887, 0.84284434703352074},
        {-75, 20, -1.3089969389957472, 0.35369316429258514},
        {60, -50, 1.0471975511965977, -0.95363706508326334},
        {-20, -85, -0.34906585039886592, -2.0474233531623209},
        {10, 5, 0.17453292519943296, 0.08733743678914905}}}}},
    {"architectural",
     {{},
      {{{30, 45, 0.52359877559829887, 0.84284434703352074},
        {-75, 20, -1.3089969389957472, 0.35369316429258514},
        {60, -50, 1.0471975511965977, -0.76604444311897804},
        {-20, -85, -0.34906585039886592, -0.99619469809174553},
        {10, 5, 0.17453292519943296, 0.08733743678914905}}}}},
    {"sinusoidal",
     {{},
      {{{30, 45, 0.37024024484653052, 0.78539816339744831},
        {-75, 20, -1.2300547642056455, 0.34906585039886592},
        {60, -50, 0.67312561080325846, -0.87266462599716479},
        {-20, -85, -0.030423093459356091, -1.4835298641951801},
        {10, 5, 0.17386877472611832, 0.087266462599716479}}}}},
    {"hammer",
     {{},
      {{{30, 45, 0.39900885089701478, 0.77082590799870129},
        {-75, 20, -1.2246640834658536, 0.36610505537636929},
        {60, -50, 0.72859160180324448, -0.86830165898298667},
        {-20, -85, -0.041079957290781843, -1.3520039966369864},
        {10, 5, 0.17397888324632525, 0.087321727158149607}}}}},
    {"mollweide",
     {{},
      {{{30, 45, 0.37990834171051643, 0.83727347210388155},
        {-75, 20, -1.1340732795970707, 0.38468692071043947},
        {60, -50, 0.71553795681451569, -0.92087579119273389},
        {-20, -85, -0.065004940922593387, -1.3836295539366436},
        {10, 5, 0.15676568859364407, 0.096881521770716486}}}}},
    {"winkel_tripel",
     {{},
      {{{30, 45, 0.37185678703262496, 0.78909595482040744},
        {-75, 20, -1.0427901269320323, 0.36170830429944965},
        {60, -50, 0.71263933866334171, -0.88837160754317843},
        {-20, -85, -0.13366685198789918, -1.4841087372935306},
        {10, 5, 0.14260015671728987, 0.087321779998457043}}}}},
    {"albers",
     {{29.5, 45.5},
      {{{30, 45, 0.36364228727066404, 0.81470515626999267},
        {-75, 20, -1.1407528137069342, 0.79593855497875825},
        {60, -50, 1.4765996334976476, -0.091469324305963144},
        {-20, -85, -0.55355905964273908, -0.66341783004937796},
        {10, 5, 0.19447294391994524, 0.086735296101924424}}}}},
    {"panini",
     {{0.5, -0.4, 0.75},
      {{{30, 45, 0.54903810567665797, 1.1313981160422108},
        {-75, 20, -1.9093995449703682, 0.84258472769301863},
        {60, -50, 1.299038105676658, -3.1283531805598011},
        {-20, -85, -0.35634704768330824, -12.482058949788846},
        {10, 5, 0.17542491004103339, 0.088687015145515425}}}}},
    {"panini_general",
     {{60, 50, -20},
      {{{30, 45, 0.55585397500729179, 1.1976988592084586},
        {-75, 20, -2.1750092896326459, 1.9930595954509897},
        {60, -50, 1.3856591206632831, -1.9886833895327754},
        {-20, -85, -0.35822312683231649, -12.032742877985469},
        {10, 5, 0.17564960629166387, 0.089179642297904641}}}}},
};

class EveryPanorama : public testing::TestWithParam<const LensModel*> {};

INSTANTIATE_TEST_SUITE_P(Camera, EveryPanorama, testing::ValuesIn(models_of("panoramic")),
                         [](const auto& lens) { return std::string(lens.param->info.name); });

TEST_P(EveryPanorama, HasTheValuesOfItsFormula) {
  const LensModel& model = *GetParam();
  const auto found = map_values.find(model.info.name);
  ASSERT_NE(found, map_values.end()) << "work out values for this lens and add them to map_values";
  const LensParameters parameters = lens_parameters(model.info, found->second.parameters);
  for (const MapPoint& point : found->second.points) {
    glm::dvec2 plane;
    ASSERT_TRUE(model.project(parameters, optical(direction_at(point.longitude_deg, point.latitude_deg)), plane));
    // Observed: 5.4e-15 of the value (mercator at 85 degrees), else below 2e-15.
    const double tolerance = 3e-14 * std::max(1.0, std::abs(point.y));
    EXPECT_NEAR(plane.x, point.x, tolerance) << point.longitude_deg << ", " << point.latitude_deg;
    EXPECT_NEAR(-plane.y, point.y, tolerance) << point.longitude_deg << ", " << point.latitude_deg;
  }
}

TEST(EquirectangularPanorama, LooksUpTheSameWithAndWithoutRanges) {
  const Camera whole = make_camera("equirectangular", ImageSize{800, 400});
  const Camera part = make_camera("equirectangular:longitude_min_deg=-90,longitude_max_deg=45", ImageSize{300, 400});
  for (const double longitude : {-89.0, -10.0, 0.0, 44.0}) {
    const glm::dvec3 direction = direction_at(longitude, 33.0);
    EXPECT_NEAR(part.project(direction)->x - whole.project(direction)->x, -200.0, 1e-10) << longitude;
    EXPECT_NEAR(part.project(direction)->y, whole.project(direction)->y, 1e-10) << longitude;
  }
}

// The derivatives of the plane's point along the parallel and the meridian, by the unit of arc.
std::array<glm::dvec2, 2> scales(const LensModel& model, const LensParameters& parameters, double longitude_deg,
                                 double latitude_deg) {
  const double step = 1e-4;  // degrees
  const auto at = [&](double longitude, double latitude) {
    glm::dvec2 plane;
    EXPECT_TRUE(model.project(parameters, optical(direction_at(longitude, latitude)), plane));
    return plane;
  };
  const glm::dvec2 east = (at(longitude_deg + step, latitude_deg) - at(longitude_deg - step, latitude_deg)) /
                          (radians(2 * step) * std::cos(radians(latitude_deg)));
  const glm::dvec2 north =
      (at(longitude_deg, latitude_deg + step) - at(longitude_deg, latitude_deg - step)) / radians(2 * step);
  return {east, north};
}

template <typename Visit>
void for_each_place(const char* name, const std::vector<double>& values, double longitudes, double latitudes,
                    Visit visit) {
  const LensModel& model = *find_lens_model(name);
  const LensParameters parameters = lens_parameters(model.info, values);
  for (int i = -5; i <= 5; ++i) {
    for (int j = -5; j <= 5; ++j) {
      // Off the axes of symmetry.
      const double longitude = longitudes * (i + 0.1) / 5.2, latitude = latitudes * (j + 0.1) / 5.2;
      const auto [east, north] = scales(model, parameters, longitude, latitude);
      visit(east, north, fmt::format("{} at {}, {}", name, longitude, latitude));
    }
  }
}

TEST(EqualAreaPanoramas, GiveEqualSolidAnglesEqualAreas) {
  size_t count = 0;
  const auto area_is_one = [&](const glm::dvec2& east, const glm::dvec2& north, const std::string& where) {
    ++count;
    // Observed: 1.6e-7 (mollweide at 87 degrees), the error of the differences.
    EXPECT_NEAR(std::abs(east.x * north.y - east.y * north.x), 1.0, 1e-6) << where;
  };
  for (const char* name : {"cylindrical_equal_area", "sinusoidal", "hammer", "mollweide", "albers", "equisolid"}) {
    for_each_place(name, {}, 178, 87, area_is_one);
  }
  for_each_place("cylindrical_equal_area", {40}, 178, 87, area_is_one);
  for_each_place("albers", {-10, -50}, 178, 87, area_is_one);
  EXPECT_EQ(count, 8U * 121U);
}

TEST(ConformalPanoramas, KeepAngles) {
  size_t count = 0;
  const auto is_similar = [&](const glm::dvec2& east, const glm::dvec2& north, const std::string& where) {
    ++count;
    const double size = glm::length(east);
    EXPECT_NEAR(glm::dot(east, north) / (size * size), 0.0, 1e-6) << where;
    EXPECT_NEAR(glm::length(north) / size, 1.0, 1e-6) << where;
  };
  for_each_place("mercator", {}, 178, 85, is_similar);
  for_each_place("transverse_mercator", {}, 170, 85, is_similar);
  for_each_place("stereographic", {}, 170, 85, is_similar);
  EXPECT_EQ(count, 3U * 121U);
}

TEST(AlbersPanorama, BecomesTheCylinderWhereItsParallelsAreOpposite) {
  const LensModel &albers = *find_lens_model("albers"), &cylinder = *find_lens_model("cylindrical_equal_area");
  const LensParameters opposite = lens_parameters(albers.info, std::vector<double>{-30, 30});
  const LensParameters nearly = lens_parameters(albers.info, std::vector<double>{-30, 30 + 1e-9});
  const LensParameters equal_area = lens_parameters(cylinder.info, std::vector<double>{30});
  for (const auto& [longitude, latitude] : {std::pair(170.0, 80.0), std::pair(-60.0, -20.0), std::pair(0.0, 90.0)}) {
    const glm::dvec3 direction = optical(direction_at(longitude, latitude));
    glm::dvec2 expected, found, near;
    ASSERT_TRUE(cylinder.project(equal_area, direction, expected));
    ASSERT_TRUE(albers.project(opposite, direction, found));
    ASSERT_TRUE(albers.project(nearly, direction, near));
    EXPECT_LT(glm::distance(found, expected), 1e-14);
    EXPECT_LT(glm::distance(near, expected), 1e-9);
    glm::dvec3 back;
    ASSERT_TRUE(albers.unproject(opposite, found * (1 - 1e-12), back));
    EXPECT_LT(glm::distance(back, direction), 3e-6);
  }
}

TEST(PaniniPanorama, IsPerspectiveAtDistanceZero) {
  const Camera panini = make_camera("panini:d=0,fov_deg=120", ImageSize{400, 300});
  const Camera perspective = make_camera("perspective:fov_deg=120", ImageSize{400, 300});
  for (const glm::dvec2& pixel : {glm::dvec2(3, 5), glm::dvec2(200, 150), glm::dvec2(390, 20)}) {
    EXPECT_LT(glm::distance(panini.unproject(pixel)->direction, perspective.unproject(pixel)->direction), 1e-14);
  }
  EXPECT_FALSE(panini.project({1, 0, 0.01}));
}

TEST(PaniniPanorama, StraightensHorizontalLinesWhereTheSqueezeIsFull) {
  // A wall ahead: its horizontal edges are straight and level at the height of the perspective view, times S.
  const LensModel& model = *find_lens_model("panini");
  const LensParameters full = lens_parameters(model.info, std::vector<double>{0, 1, 1});
  const LensParameters none = lens_parameters(model.info, std::vector<double>{0, 0, 0});
  for (const double x : {0.0, 0.5, 2.0}) {
    glm::dvec2 straight, bent;
    ASSERT_TRUE(model.project(full, glm::dvec3(x, 0.4, 1.0), straight));
    ASSERT_TRUE(model.project(none, glm::dvec3(x, 0.4, 1.0), bent));
    EXPECT_NEAR(straight.y / bent.y, std::sqrt(1 + x * x), 1e-14) << x;
  }
}

TEST(PaniniPanorama, IsCalledEquiPaniniByHugin) {
  EXPECT_EQ(make_camera("equi_panini").lens()->model, find_lens_model("panini"));
  // Hugin's: x = 2 tan(longitude/2), y = tan(latitude) / cos²(longitude/2).
  const LensModel& model = *find_lens_model("panini");
  glm::dvec2 plane;
  ASSERT_TRUE(model.project(lens_parameters(model.info), optical(direction_at(60, 40)), plane));
  EXPECT_NEAR(plane.x, 2 * std::tan(radians(30)), 1e-15);
  EXPECT_NEAR(-plane.y, std::tan(radians(40)) / std::pow(std::cos(radians(30)), 2), 1e-14);
}

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
