// Cameras as text: what each parameter means, what is refused and how, the way back, and the tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/camera/camera.h"
#include "omma/camera/camera_parameters.h"
#include "omma/camera/field_of_view.h"
#include "omma/camera/lens_table.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

constexpr double radians(double deg) { return deg * 3.14159265358979323846 / 180.0; }

// The message of the CommandError that the text is refused with.
std::string refusal(const std::string& text, std::optional<ImageSize> size = {}) {
  try {
    make_camera(text, size);
  } catch (const CommandError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts,
                    std::optional<ImageSize> size = {}) {
  const std::string message = refusal(text, size);
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << text << " gives: " << message;
  }
}

TEST(CameraText, TakesEveryLensByEachOfItsNamesAndNoNameTwice) {
  std::map<std::string, std::string> owners;
  for (const LensModel& model : lens_models()) {
    std::vector<std::string> names = other_names(model.info);
    names.emplace_back(model.info.name);
    for (const LensPreset& preset : model.info.presets) names.emplace_back(preset.name);
    for (const std::string& name : names) {
      EXPECT_TRUE(owners.emplace(name, model.info.name).second) << name << " also means " << owners[name];
      EXPECT_EQ(make_camera(example_as(model, name)).lens()->model, &model) << name;
    }
  }
  EXPECT_GE(owners.size(), 2 * lens_models().size());
}

TEST(CameraText, HasADefaultSize) {
  EXPECT_EQ(make_camera("perspective").size(), (ImageSize{1600, 1200}));
  EXPECT_EQ(make_camera("perspective", ImageSize{20, 10}).size(), (ImageSize{20, 10}));
}

// The angle between the axis and the ray at a pixel, in degrees; nothing: not seen.
std::optional<double> degrees_at(const Camera& camera, const glm::dvec2& pixel) {
  const auto ray = camera.unproject(pixel);
  if (!ray) return {};
  const glm::dvec3& d = ray->direction;
  return std::atan2(std::hypot(d.x, d.y), -d.z) / radians(1);
}

TEST(CameraText, SpansTheExtentThatFitNames) {
  struct Case {
    const char* fit;
    glm::dvec2 edge;  // a point of a 400 x 300 image at half the field of view
  };
  const Case cases[] = {{"width", {400, 150}},  {"height", {200, 300}}, {"shorter", {200, 300}},
                        {"circle", {200, 300}}, {"longer", {400, 150}}, {"diagonal", {400, 300}},
                        {"full", {400, 300}}};
  size_t count = 0, expected = 0;
  for (const LensModel& model : lens_models()) {
    // A layout has no field of view; the parallels of a conic are no rows.
    const std::string_view name = model.info.name;
    if (model.info.max_fov_deg == 0 || name == "albers" || name == "lambert_conformal_conic") continue;
    expected += 5;
    for (const auto& [fit, edge] : cases) {
      const std::string text = fmt::format("{}:fov_deg=120,fit={},width=400,height=300", model.info.name, fit);
      if (!model.info.radial && edge == glm::dvec2(400, 300)) {
        expect_refused(text, {"fit=", "width, height, shorter or longer"});
        continue;
      }
      const glm::dvec2 inside = edge + (glm::dvec2(200, 150) - edge) * 1e-12;
      const auto angle = degrees_at(make_camera(text), inside);
      ASSERT_TRUE(angle) << text;
      EXPECT_NEAR(*angle, 60.0, 1e-8) << text;
      ++count;
    }
  }
  EXPECT_GE(count, expected);
}

TEST(CameraText, DrawsACircleOnlyWithTheShorterSide) {
  for (const LensModel& model : lens_models()) {
    if (!model.info.radial) continue;
    const auto camera = [&](const char* fit) {
      return make_camera(fmt::format("{}:fov_deg=100,fit={},width=400,height=300", model.info.name, fit));
    };
    EXPECT_NEAR(camera("circle").lens()->parameters.max_angle, radians(50), 1e-15) << model.info.name;
    EXPECT_FALSE(camera("circle").unproject({351.0, 150.0})) << model.info.name;
    EXPECT_TRUE(camera("circle").unproject({349.0, 150.0})) << model.info.name;
    for (const char* fit : {"width", "height", "longer", "full"}) {
      EXPECT_EQ(camera(fit).lens()->parameters.max_angle, lens_parameters(model.info).max_angle)
          << model.info.name << fit;
    }
    EXPECT_TRUE(camera("full").unproject({0.5, 0.5})) << model.info.name;
  }
}

TEST(CameraText, TakesAnExplicitMaximumAngle) {
  const Camera wide = make_camera("equidistant:fov_deg=180,max_angle_deg=95,width=300,height=300");
  EXPECT_NEAR(wide.lens()->parameters.max_angle, radians(95), 1e-15);
  const Camera panorama = make_camera("equirectangular:max_angle_deg=90,width=400,height=200");
  EXPECT_TRUE(panorama.unproject({101.0, 100.0}));
  EXPECT_FALSE(panorama.unproject({99.0, 100.0}));
  expect_refused("orthographic_fisheye:max_angle_deg=91", {"max_angle_deg=91 is out of range", "to 90"});
  expect_refused("equidistant:max_angle_deg=0", {"out of range"});
}

TEST(CameraText, TakesNamesThatSetParameters) {
  const auto same = [](const char* a, const char* b) {
    EXPECT_EQ(to_text(make_camera(a, ImageSize{80, 60})), to_text(make_camera(b, ImageSize{80, 60}))) << a;
  };
  same("mirror_ball", "equisolid:fov_deg=360");
  same("MIRROR_BALL:fov_deg=270", "equisolid:fov_deg=270");
  same("ball:f=20", "equisolid:f=20");
  same("hequirect", "equirectangular:longitude_min_deg=-90,longitude_max_deg=90");
  same("gall_peters", "cylindrical_equal_area:parallel_deg=45");
  expect_refused("mirror_ball:d=1", {"unknown mirror_ball parameter 'd'"});
}

TEST(CameraText, FillsTheImageWithAPartOfTheSphere) {
  const char* text =
      "equirectangular:longitude_min_deg=-30,longitude_max_deg=90,latitude_min_deg=-20,latitude_max_deg=60";
  const Camera camera = make_camera(text, ImageSize{240, 320});
  EXPECT_LT(glm::distance(camera.lens()->focal, glm::dvec2(120, 240) / radians(60)), 1e-12);
  const auto at = [](double longitude, double latitude) {
    const double a = radians(longitude), b = radians(latitude);
    return glm::dvec3(std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b));
  };
  EXPECT_LT(glm::distance(*camera.project(at(-30, 60)), {0, 0}), 1e-11);
  EXPECT_LT(glm::distance(*camera.project(at(90, -20)), {240, 320}), 1e-11);
  EXPECT_LT(glm::distance(*camera.project(at(30, 20)), {120, 160}), 1e-11);
  EXPECT_FALSE(camera.project(at(-31, 0)));
  EXPECT_FALSE(camera.project(at(91, 0)));
  EXPECT_FALSE(camera.project(at(0, 61)));
  EXPECT_FALSE(camera.project(at(0, -21)));
  EXPECT_FALSE(camera.unproject({-0.1, 160}));
  EXPECT_FALSE(camera.unproject({120, 320.1}));
  // What lies behind, across the seam.
  const Camera behind = make_camera("equirectangular:longitude_min_deg=90,longitude_max_deg=270", ImageSize{180, 180});
  EXPECT_LT(glm::distance(*behind.project(at(180, 0)), {90, 90}), 1e-11);
  EXPECT_LT(glm::distance(*behind.project(at(-100, 45)), {170, 45}), 1e-11);
  EXPECT_FALSE(behind.project(at(0, 0)));
  // A focal length instead shows the same part at another scale.
  EXPECT_FALSE(make_camera(std::string(text) + ",f=100", ImageSize{600, 600}).project(at(-31, 0)));
  expect_refused(std::string(text) + ",fov_deg=90", {"fov_deg has no place", "fills the image"});
  expect_refused("equirectangular:longitude_min_deg=10,longitude_max_deg=10", {"longitude_min_deg", "less than"});
  expect_refused("equirectangular:longitude_min_deg=-200,longitude_max_deg=170", {"by 360 at most"});
  expect_refused("equirectangular:latitude_min_deg=50,latitude_max_deg=40", {"latitude_min_deg", "less than"});
}

TEST(CameraText, TakesIntrinsics) {
  const Lens lens = *make_camera("opencv_fisheye:fx=190,fy=191,cx=254.5,cy=256.5,width=512,height=480,k2=0.01").lens();
  EXPECT_EQ(lens.focal, glm::dvec2(190, 191));
  EXPECT_EQ(lens.centre, glm::dvec2(254.5, 256.5));
  EXPECT_EQ(lens.size, (ImageSize{512, 480}));
  EXPECT_EQ(lens.parameters.k[1], 0.01);
  const Lens centred = *make_camera("perspective:f=100", ImageSize{64, 48}).lens();
  EXPECT_EQ(centred.focal, glm::dvec2(100));
  EXPECT_EQ(centred.centre, glm::dvec2(32, 24));
}

TEST(CameraText, ScalesIntrinsicsToAnotherSizeOfTheSameShape) {
  const char* text = "opencv_fisheye:fx=190,fy=191,cx=254.5,cy=256.5,width=512,height=480";
  const Lens half = *make_camera(text, ImageSize{256, 240}).lens();
  EXPECT_EQ(half.focal, glm::dvec2(95, 95.5));
  EXPECT_EQ(half.centre, glm::dvec2(127.25, 128.25));
  EXPECT_EQ(half.size, (ImageSize{256, 240}));
  expect_refused(text, {"512 x 480", "256 x 256", "another shape", "256 x 240"}, ImageSize{256, 256});
  // The corners see the same.
  for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0.3, 1)}) {
    const auto a = make_camera(text).unproject(corner * glm::dvec2(512, 480));
    const auto b = make_camera(text, ImageSize{1024, 960}).unproject(corner * glm::dvec2(1024, 960));
    ASSERT_TRUE(a && b);
    EXPECT_LT(glm::distance(a->direction, b->direction), 1e-14);
  }
}

TEST(CameraText, ShiftsThePrincipalPointOfAFieldOfView) {
  const Lens lens = *make_camera("perspective:fov_deg=90,cx=10,cy=20", ImageSize{100, 60}).lens();
  EXPECT_NEAR(lens.focal.x, 50.0, 1e-12);
  EXPECT_EQ(lens.centre, glm::dvec2(10, 20));
}

TEST(CameraText, RefusesFieldsOfViewOutOfRange) {
  for (const LensModel& model : lens_models()) {
    const LensInfo& info = model.info;
    const std::string name = info.name;
    if (info.max_fov_deg == 0) {
      expect_refused(name + ":fov_deg=90", {"fov_deg has no place", "fills the image"});
      expect_refused(name + ":fit=width", {"fit has no place"});
      continue;
    }
    if (widest_fov_deg(info) == 0.98 * info.max_fov_deg || widest_fov_deg(info) == info.max_fov_deg) {
      const std::string at_limit = fmt::format("{}:fov_deg={}", name, info.max_fov_deg);
      if (info.max_fov_inclusive) {
        EXPECT_EQ(refusal(at_limit), "accepted");
      } else {
        expect_refused(at_limit, {fmt::format("less than {}", info.max_fov_deg)});
      }
      expect_refused(fmt::format("{}:fov_deg={}", name, info.max_fov_deg + 0.1),
                     {name + ": fov_deg=", "out of range", fmt::format("{} is accepted", info.max_fov_deg)});
    } else {  // the default parameters allow less
      const double limit_deg = lens_parameters(info).max_angle / radians(0.5);
      EXPECT_EQ(refusal(fmt::format("{}:fov_deg={}", name, limit_deg)), "accepted");
      expect_refused(fmt::format("{}:fov_deg={}", name, limit_deg + 0.1),
                     {name + ": fov_deg=", "out of range", fmt::format("{} is accepted", limit_deg)});
    }
    for (const char* bad : {"0", "-10", "1e-9", "1e300"}) {
      expect_refused(fmt::format("{}:fov_deg={}", name, bad), {"fov_deg=", "out of range"});
    }
    for (const char* bad : {"nan", "inf", "", "9x", "90 "}) {
      expect_refused(fmt::format("{}:fov_deg={}", name, bad), {name + ": fov_deg", "not a finite number"});
    }
  }
  expect_refused("cylinder:fov_deg=180,fit=height", {"less than 180", "along the height"});
  EXPECT_EQ(refusal("equirectangular:fov_deg=180,fit=height"), "accepted");
  expect_refused("equirectangular:fov_deg=181,fit=height", {"to 180", "along the height"});
  expect_refused("opencv_fisheye:fov_deg=250,k1=-0.1", {"out of range", "to 209.2"});
}

TEST(CameraText, RefusesWhatMakesNoSense) {
  expect_refused("equidistnt", {"unknown camera 'equidistnt'", "did you mean 'equidistant'", "perspective", ".npy"});
  expect_refused("equidistant:fov=180", {"unknown equidistant parameter 'fov'", "fov_deg"});
  expect_refused("equidistant:k1=0.1", {"unknown equidistant parameter 'k1'"});
  expect_refused("equidistant:fit=widh", {"equidistant: unknown fit 'widh'", "did you mean 'width'"});
  expect_refused("equidistant:fov_deg", {"'fov_deg' is not key=value"});
  expect_refused("equidistant:fov_deg=1,fov_deg=2", {"given twice"});
  expect_refused("", {"name is expected"});
  expect_refused("equidistant:fov_deg=90,f=100", {"f and fov_deg"});
  expect_refused("equidistant:fit=width,fx=100,fy=100", {"fx and fit"});
  expect_refused("equidistant:f=100,fx=100", {"both fx and fy"});
  expect_refused("equidistant:fx=100", {"fy is missing"});
  expect_refused("equidistant:fy=100", {"fx is missing"});
  expect_refused("equidistant:f=0", {"f=0 is out of range"});
  expect_refused("equidistant:fx=-1,fy=1", {"fx=-1 is out of range"});
  expect_refused("equidistant:width=100", {"height is missing"});
  expect_refused("equidistant:width=0,height=100", {"0 x 100", "1 to 65536"});
  expect_refused("equidistant:width=99999999999,height=100", {"1 to 65536"});
  expect_refused("equidistant:width=10.5,height=100", {"width", "not a whole number"});
  expect_refused("opencv_fisheye", {"fov_deg is missing", "fx"});
  expect_refused("opencv_fisheye:f=100,k1=11", {"k1=11 is out of range; -10 to 10"});
  expect_refused("equidistant:cx=1e6", {"sees nothing"});
  expect_refused("perspective:cx=1e300", {"sees nothing"});
  expect_refused("equidistant", {"size", "0 x 5"}, ImageSize{0, 5});
  expect_refused("equidistant", {"size", "-3 x 5"}, ImageSize{-3, 5});
  expect_refused("equidistant", {"size", "65537"}, ImageSize{65537, 5});
}

TEST(CameraText, ComesBackAsTheSameCamera) {
  size_t count = 0;
  for (const LensModel& model : lens_models()) {
    for (const auto& [text, camera] : sample_cameras(model)) {
      const std::string written = to_text(camera);
      const Lens& a = *camera.lens();
      const Camera again = make_camera(written);
      const Lens& b = *again.lens();
      EXPECT_EQ(a.model, b.model) << written;
      EXPECT_EQ(a.size, b.size) << written;
      EXPECT_EQ(a.focal, b.focal) << written;
      EXPECT_EQ(a.centre, b.centre) << written;
      EXPECT_EQ(a.parameters.k, b.parameters.k) << written;
      EXPECT_NEAR(a.parameters.max_angle, b.parameters.max_angle, 1e-15) << written;
      EXPECT_EQ(to_text(again), written);
      ++count;
    }
  }
  EXPECT_GE(count, 5 * lens_models().size());
  EXPECT_EQ(to_text(make_camera("pinhole:f=50", ImageSize{20, 10})), "perspective:f=50,cx=10,cy=5,width=20,height=10");
}

TEST(FieldOfView, IsMeasuredFromRays) {
  const FieldOfView perspective = field_of_view(make_camera("perspective:fov_deg=90", ImageSize{200, 100}));
  EXPECT_NEAR(*perspective.horizontal_deg, 90.0, 1e-10);
  EXPECT_NEAR(*perspective.vertical_deg, 2 * std::atan(0.5) / radians(1), 1e-10);
  EXPECT_NEAR(*perspective.diagonal_deg, 2 * std::atan(std::sqrt(1.25)) / radians(1), 1e-10);
  // The image circle ends before the image does.
  const FieldOfView circle = field_of_view(make_camera("equidistant:fov_deg=220", ImageSize{400, 300}));
  for (const auto& deg : {circle.horizontal_deg, circle.vertical_deg, circle.diagonal_deg}) {
    EXPECT_NEAR(*deg, 220.0, 1e-8);
  }
  const FieldOfView panorama = field_of_view(make_camera("equirectangular", ImageSize{400, 200}));
  EXPECT_NEAR(*panorama.horizontal_deg, 360.0, 1e-8);
  EXPECT_NEAR(*panorama.vertical_deg, 180.0, 1e-8);
  const FieldOfView shifted = field_of_view(make_camera("perspective:f=100,cx=0", ImageSize{100, 100}));
  EXPECT_NEAR(*shifted.horizontal_deg, 45.0, 1e-10);
  EXPECT_FALSE(field_of_view(make_camera("equidistant:fov_deg=90,cx=0", ImageSize{400, 100})).horizontal_deg);
}

TEST(PixelsPerRadian, IsTheDensityAtTheCentre) {
  EXPECT_NEAR(make_camera("perspective:f=500").pixels_per_radian(), 500.0, 1e-3);
  EXPECT_NEAR(make_camera("equidistant:fx=500,fy=700").pixels_per_radian(), 700.0, 1e-3);
  EXPECT_NEAR(make_camera("cylinder:width=628,height=100").pixels_per_radian(), 314.0 / radians(180), 1e-3);
  // The image's centre is not seen: the nearest ray counts.
  EXPECT_NEAR(make_camera("equidistant:fov_deg=90,cx=0", ImageSize{400, 100}).pixels_per_radian(), 50.0 / radians(45),
              0.5);
}

TEST(LensTable, NamesEveryLensAndParameter) {
  for (const std::string& table : {lens_table_markdown(), lens_table_text()}) {
    for (const LensModel& model : lens_models()) {
      EXPECT_NE(std::ranges::find(lens_groups, std::string(model.info.group)), lens_groups.end()) << model.info.name;
      for (const LensPreset& preset : model.info.presets) {
        EXPECT_NE(table.find(fmt::format("{} ({})", preset.name, preset.settings)), std::string::npos) << preset.name;
      }
      for (const char* fact : {model.info.name, model.info.also, model.info.formula, model.info.source}) {
        EXPECT_NE(table.find(fact), std::string::npos) << fact;
      }
      for (const LensParameterInfo& parameter : model.info.parameters) {
        EXPECT_NE(table.find(parameter.description), std::string::npos) << parameter.name;
        // The example shows what each parameter looks like.
        EXPECT_NE(std::string(model.info.example).find(std::string(parameter.name) + "="), std::string::npos);
      }
    }
    for (const CameraParameterInfo& parameter : common_camera_parameters()) {
      EXPECT_NE(table.find(parameter.description), std::string::npos) << parameter.name;
    }
  }
  // Every row of a Markdown table has as many cells as its head.
  size_t cells = 0, rows = 0;
  for (const std::string& line : split(lens_table_markdown(), '\n')) {
    const auto bars = static_cast<size_t>(std::ranges::count(line, '|'));
    if (bars > 0 && cells > 0) {
      EXPECT_EQ(bars, cells) << line;
    }
    cells = bars;
    rows += bars > 0;
  }
  EXPECT_GT(rows, lens_models().size() + 10);
}

}  // namespace
}  // namespace omma
