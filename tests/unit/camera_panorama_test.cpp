// Panoramas: values worked out from the published formulae, and what each projection preserves.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "omma/camera/camera.h"
#include "tests/unit/camera_directions.h"

namespace omma {
namespace {

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
    {"lambert_conformal_conic",
     {{20, 50},
      {{{30, 45, 0.35723501904240999, 0.85199743120646457},
        {-75, 20, -1.1151022445371425, 0.81722844579299774},
        {60, -50, 2.0441405013851139, -0.94754245282124650},
        {-20, -85, -2.4659968266315662, -10.014375314746106},
        {10, 5, 0.19139135462317675, 0.10815840586355972}}}}},
    {"biplane",
     {{60},
      {{{30, 45, 0.57735026918962576, 1.0},
        {-75, 20, -1.5773502691896258, 0.51473164159937599},
        {60, -50, 1.1547005383792515, -1.3761185149839414},
        {-20, -85, -0.40102328848116079, -11.606379283469808},
        {10, 5, 0.21338003492342340, 0.093103491067912389}}}}},
    {"triplane",
     {{50},
      {{{30, 45, 0.56864508204379482, 1.0641777724759121},
        {-75, 20, -1.3989229744649958, 0.40159671964893297},
        {60, -50, 1.1089422970184622, -1.2101383127306031},
        {-20, -85, -0.36397023426620236, -12.163607598835736},
        {10, 5, 0.17632698070846497, 0.088838317182540968}}}}},
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
  for_each_place("lambert_conformal_conic", {}, 178, 85, is_similar);
  for_each_place("lambert_conformal_conic", {-10, -50}, 178, 85, is_similar);
  for_each_place("lambert_conformal_conic", {60, 60}, 178, 85, is_similar);
  EXPECT_EQ(count, 6U * 121U);
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

TEST(LambertConformalConicPanorama, BecomesMercatorWhereItsParallelsAreOpposite) {
  const LensModel &conic = *find_lens_model("lambert_conformal_conic"), &mercator = *find_lens_model("mercator");
  const LensParameters opposite = lens_parameters(conic.info, std::vector<double>{-30, 30});
  const LensParameters nearly = lens_parameters(conic.info, std::vector<double>{-30, 30 + 1e-9});
  for (const auto& [longitude, latitude] : {std::pair(170.0, 80.0), std::pair(-60.0, -20.0), std::pair(5.0, 0.0)}) {
    const glm::dvec3 direction = optical(direction_at(longitude, latitude));
    glm::dvec2 expected, found, near;
    ASSERT_TRUE(mercator.project(lens_parameters(mercator.info), direction, expected));
    ASSERT_TRUE(conic.project(opposite, direction, found));
    ASSERT_TRUE(conic.project(nearly, direction, near));
    // True to scale at 30 degrees instead of at the equator.
    expected *= std::cos(radians(30));
    EXPECT_LT(glm::distance(found, expected), 2e-15);
    EXPECT_LT(glm::distance(near, expected), 1e-9);
    for (const LensParameters& parameters : {opposite, nearly}) {
      glm::dvec3 back;
      ASSERT_TRUE(conic.unproject(parameters, found, back));
      EXPECT_LT(glm::distance(back, direction), 1e-9);
    }
  }
}

TEST(LambertConformalConicPanorama, IsTrueToScaleOnItsParallels) {
  const LensModel& model = *find_lens_model("lambert_conformal_conic");
  for (const std::array<double, 2>& parallels : {std::array{20.0, 50.0}, {-60.0, 10.0}, {45.0, 45.0}}) {
    const LensParameters parameters = lens_parameters(model.info, parallels);
    for (const double latitude : parallels) {
      const auto [east, north] = scales(model, parameters, 33, latitude);
      EXPECT_NEAR(glm::length(east), 1.0, 1e-9) << latitude;
      EXPECT_NEAR(glm::length(north), 1.0, 1e-9) << latitude;
    }
  }
}

TEST(PlanePanoramas, KeepStraightLinesWithinAPlane) {
  // A rod beside the camera: its picture is bent at the corner alone.
  for (const auto& [name, corner] : {std::pair("biplane", 0.0), {"triplane", std::tan(radians(22.5))}}) {
    const LensModel& model = *find_lens_model(name);
    const LensParameters parameters = lens_parameters(model.info);
    std::array<glm::dvec2, 3> points;
    const auto bend = [&](double from, double to) {
      for (int i = 0; i < 3; ++i) {
        const double x = from + 0.5 * i * (to - from);
        EXPECT_TRUE(model.project(parameters, {x, -0.7 + 0.1 * x, 1.0}, points[static_cast<size_t>(i)]));
      }
      const glm::dvec2 a = points[1] - points[0], b = points[2] - points[0];
      return std::abs(a.x * b.y - a.y * b.x) / (glm::length(a) * glm::length(b));
    };
    EXPECT_LT(bend(corner + 0.01, 5.0), 1e-14) << name;
    EXPECT_LT(bend(-5.0, -corner - 0.01), 1e-14) << name;
    EXPECT_GT(bend(corner - 0.3, corner + 0.3), 0.05) << name;
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

}  // namespace
}  // namespace omma
