// Calibrated lenses: their names in other tools, where they end, and that no parameters lead them astray.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "omma/base/error.h"
#include "omma/camera/camera.h"

namespace omma {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double degrees(double radians) { return radians * 180.0 / pi; }

double max_angle_deg(const std::string& text) { return degrees(make_camera(text).lens()->parameters.max_angle); }

std::string refusal(const std::string& text) {
  try {
    make_camera(text);
  } catch (const CommandError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CalibratedLenses, AreFoundByTheNamesOfOtherTools) {
  const std::pair<const char*, const char*> names[] = {
      // COLMAP
      {"SIMPLE_PINHOLE", "perspective"},
      {"PINHOLE", "perspective"},
      {"SIMPLE_RADIAL", "opencv"},
      {"RADIAL", "opencv"},
      {"OPENCV", "opencv"},
      {"FULL_OPENCV", "opencv"},
      {"OPENCV_FISHEYE", "opencv_fisheye"},
      {"SIMPLE_RADIAL_FISHEYE", "opencv_fisheye"},
      {"RADIAL_FISHEYE", "opencv_fisheye"},
      {"SIMPLE_FISHEYE", "equidistant"},
      {"FISHEYE", "equidistant"},
      {"FOV", "fov"},
      {"THIN_PRISM_FISHEYE", "thin_prism_fisheye"},
      {"RAD_TAN_THIN_PRISM_FISHEYE", "fisheye624"},
      {"SIMPLE_DIVISION", "division"},
      {"DIVISION", "division"},
      {"EUCM", "eucm"},
      {"EQUIRECTANGULAR", "equirectangular"},
      // nerfstudio, Kalibr, Basalt, ROS, Blender
      {"FISHEYE624", "fisheye624"},
      {"pinhole-radtan", "opencv"},
      {"pinhole-equi", "opencv_fisheye"},
      {"pinhole-fov", "fov"},
      {"omni-radtan", "mei"},
      {"eucm-none", "eucm"},
      {"ds-none", "double_sphere"},
      {"pinhole", "perspective"},
      {"kb4", "opencv_fisheye"},
      {"ds", "double_sphere"},
      {"eucm", "eucm"},
      {"ucm", "eucm"},
      {"plumb_bob", "opencv"},
      {"rational_polynomial", "opencv"},
      {"FISHEYE_LENS_POLYNOMIAL", "blender_polynomial"},
  };
  for (const auto& [name, lens] : names) {
    const LensModel* found = find_lens_model(name);
    ASSERT_TRUE(found) << name;
    EXPECT_STREQ(found->info.name, lens) << name;
  }
}

TEST(CalibratedLenses, EndWhereTheirFormulaDoes) {
  const auto fov = [](const char* lens, const char* parameters) {
    return max_angle_deg(fmt::format("{}:f=100,{}", lens, parameters));
  };
  // 1 + 3 k1 r² = 0
  EXPECT_NEAR(fov("opencv", "k1=-0.25"), degrees(std::atan(std::sqrt(4.0 / 3.0))), 1e-9);
  // r / (1 + k4 r²) turns at r = 1/√k4, and has a pole where k4 r² = −1
  EXPECT_NEAR(fov("opencv", "k4=0.25"), degrees(std::atan(2.0)), 1e-9);
  EXPECT_NEAR(fov("opencv", "k4=-0.25"), degrees(std::atan(2.0)), 1e-9);
  EXPECT_NEAR(fov("opencv", "k1=0.1"), 90.0, 1e-3);
  EXPECT_NEAR(fov("division", "k=0.25"), 45.0, 1e-9);
  EXPECT_NEAR(fov("division", "k=-0.25"), 180.0, 1e-3);
  EXPECT_NEAR(fov("eucm", "alpha=0"), 90.0, 1e-3);
  EXPECT_NEAR(fov("ucm", "alpha=0.5"), 180.0, 1e-3);
  EXPECT_NEAR(fov("ucm", "alpha=0.25"), degrees(std::acos(-1.0 / 3.0)), 1e-3);  // r is infinite
  EXPECT_NEAR(fov("ucm", "alpha=0.8"), degrees(std::acos(-0.25)), 1e-9);        // r turns
  EXPECT_NEAR(fov("mei", "xi=0"), 90.0, 1e-3);
  EXPECT_NEAR(fov("mei", "xi=2"), 120.0, 1e-9);
  EXPECT_NEAR(fov("mei", "xi=1,k1=-0.25"), degrees(2 * std::atan(std::sqrt(4.0 / 3.0))), 1e-9);
  // The paper's w2 for xi = 0 is ucm's; for alpha 0 the first sphere's shadow ends it.
  EXPECT_NEAR(fov("ds", "xi=0,alpha=0.8"), degrees(std::acos(-0.25)), 1e-9);
  EXPECT_NEAR(fov("ds", "xi=0.5,alpha=0"), degrees(std::acos(-0.5 / std::sqrt(1.25))), 1e-3);
  EXPECT_NEAR(fov("polynomial", "k1=1,k2=-0.5"), degrees(1.0), 1e-9);
  EXPECT_NEAR(fov("ftheta", "k1=1,k3=-0.3333333333333333"), degrees(1.0), 1e-6);
  // θ = r − r²/4 rises up to r = 2.
  EXPECT_NEAR(fov("ftheta", "k1=1,k2=-0.25,reference=pixeldist_to_angle"), degrees(1.0), 1e-9);
  EXPECT_NEAR(fov("blender_polynomial", "k1=-1,k2=0.25"), degrees(1.0), 1e-9);
  // −a0 + a2 r² = 0 at r = 2, where the ray is (2, 1 + 1).
  EXPECT_NEAR(fov("ocam", "a0=-1,a2=-0.25"), 45.0, 1e-9);
  EXPECT_NEAR(fov("thin_prism_fisheye", "k1=-0.3333333333333333"), degrees(1.0), 1e-6);
  EXPECT_NEAR(fov("fisheye624", "k0=-0.3333333333333333"), degrees(1.0), 1e-6);
}

TEST(CalibratedLenses, HaveNoRayBeyondTheirEnd) {
  // r (1 − r²/4) rises up to r = √(4/3), where it is 0.7698.
  const Camera camera = make_camera("opencv:f=100,k1=-0.25,width=300,height=300");
  EXPECT_TRUE(camera.unproject({150 + 76.9, 150}));
  EXPECT_FALSE(camera.unproject({150 + 77.1, 150}));
  EXPECT_TRUE(camera.project({1.15, 0, -1}));
  EXPECT_FALSE(camera.project({1.16, 0, -1}));
  // Tangential and prism terms fold the plane too: this one at 1 + 6 p2 r = 0, and on the way p1 and s3.
  const double tangential = max_angle_deg("opencv:f=100,p2=-0.1");
  EXPECT_NEAR(std::tan(tangential * pi / 180), 1 / 0.6, 0.01);
}

TEST(CalibratedLenses, RefuseParametersThatGiveNoImage) {
  EXPECT_NE(refusal("polynomial:f=1,k1=-1").find("does not grow"), std::string::npos);
  EXPECT_NE(refusal("blender_polynomial:sensor_mm=36,k1=0.1").find("does not grow"), std::string::npos);
  EXPECT_NE(refusal("ftheta:f=1,k1=0,reference=pixeldist_to_angle").find("does not grow"), std::string::npos);
  EXPECT_NE(refusal("ocam:f=1,a0=1").find("a0=1 is out of range"), std::string::npos);
  EXPECT_NE(refusal("eucm:f=100,alpha=1.1").find("0 to 1"), std::string::npos);
}

TEST(CalibratedLenses, TakeChoicesByName) {
  const std::string message = refusal("ftheta:f=1,reference=angle_to_pixeldst");
  EXPECT_NE(message.find("unknown reference 'angle_to_pixeldst'; did you mean 'angle_to_pixeldist'"), std::string::npos)
      << message;
  EXPECT_NE(refusal("custom_radial:f=1,fun=1").find("one of: tan, sin, id"), std::string::npos);
  const Camera camera = make_camera("custom_radial:f=100,fun=id,c2=2,width=100,height=100");
  EXPECT_NE(to_text(camera).find(",fun=id"), std::string::npos);
  EXPECT_NEAR(camera.project({1, 0, 0})->x, 50 + 100 * pi / 4, 1e-12);
}

TEST(CalibratedLenses, TakeMillimetres) {
  // 8 mm on a sensor 36 mm wide.
  EXPECT_NEAR(make_camera("equisolid:f_mm=8,sensor_mm=36,width=720,height=480").lens()->focal.x, 160.0, 1e-12);
  EXPECT_NEAR(make_camera("blender_polynomial:sensor_mm=36,width=720,height=480").lens()->focal.x, 20.0, 1e-12);
  const std::pair<const char*, const char*> refused[] = {
      {"equisolid:f_mm=8", "sensor_mm is missing"},
      {"equisolid:sensor_mm=36", "f_mm is missing"},
      {"equisolid:sensor_mm=36,fov_deg=90", "sensor_mm and fov_deg"},
      {"equisolid:f=100,f_mm=8,sensor_mm=36", "f_mm and f "},
      {"equisolid:f_mm=0,sensor_mm=36", "f_mm=0 is out of range"},
      {"blender_polynomial:f_mm=8,sensor_mm=36", "f_mm has no place"},
  };
  for (const auto& [text, part] : refused) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << text << " gives: " << refusal(text);
  }
}

TEST(CalibratedLenses, AgreeWhereTheyAreTheSame) {
  const std::pair<const char*, const char*> pairs[] = {
      {"ucm:f=100,alpha=0.6", "mei:f=250,xi=1.5"},  // xi = α / (1 − α), f = f (1 + xi)
      {"ucm:f=100,alpha=0.6", "double_sphere:f=100,xi=0,alpha=0.6"},
      {"ucm:f=100,alpha=0.5", "stereographic:f=100"},
      {"division:f=100,k=-0.25", "stereographic:f=100"},
      {"ocam:f=1,a0=-100,a2=0.0025", "stereographic:f=100"},
      {"opencv:f=100", "perspective:f=100"},
      {"polynomial:f=100", "equidistant:f=100"},
      {"ftheta:f=1,k1=0.01,reference=pixeldist_to_angle", "equidistant:f=100"},
      {"opencv_fisheye:f=100,k1=-0.02,k2=0.001", "thin_prism_fisheye:f=100,k1=-0.02,k2=0.001"},
      {"opencv_fisheye:f=100,k1=-0.02,k2=0.001", "fisheye624:f=100,k0=-0.02,k1=0.001"},
      {"custom_radial:f=100,c1=2,c2=2,fun=sin", "equisolid:f=100"},
  };
  for (const auto& [a, b] : pairs) {
    const Camera first = make_camera(a, ImageSize{200, 200}), second = make_camera(b, ImageSize{200, 200});
    for (int i = 0; i < 400; ++i) {
      const glm::dvec2 pixel(5.0 + 9.5 * (i % 20), 5.0 + 9.5 * (i / 20));
      const auto ray = first.unproject(pixel), other = second.unproject(pixel);
      ASSERT_TRUE(ray && other) << a << " at " << pixel.x << ' ' << pixel.y;
      // Observed: 6e-16.
      EXPECT_LT(glm::distance(ray->direction, other->direction), 1e-14) << a << " and " << b;
    }
  }
}

TEST(CalibratedLenses, DrawBlendersPolynomialAsBlenderDoes) {
  // The defaults of Blender's camera: the ray at r mm from the middle has θ = −(k0 + k1 r + k2 r² + k3 r³ + k4 r⁴).
  const Camera camera = make_camera(
      "blender_polynomial:sensor_mm=36,width=1800,height=1800,max_angle_deg=90,k0=-1.1735143712967577e-05,"
      "k1=-0.019988736953434998,k2=-3.3525322965709175e-06,k3=3.099275275886036e-06,k4=-2.6064646454854524e-08");
  const auto ray = camera.unproject({900 + 10 * 50.0, 900});
  ASSERT_TRUE(ray);
  EXPECT_NEAR(std::atan2(ray->direction.x, -ray->direction.z), 0.197395729096383, 1e-12);
  EXPECT_NEAR(camera.project(ray->direction)->x, 1400.0, 1e-9);
  // Between the axis and −k0 there is only the middle of the image.
  EXPECT_EQ(camera.project({0, 0, -1}), (glm::dvec2(900, 900)));
}

// Values in a parameter's range: its ends, its default, small ones and ordinary ones.
double random_value(const LensParameterInfo& parameter, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  switch (random() % 8) {
    case 0:
      return parameter.min;
    case 1:
      return parameter.max;
    case 2:
      return parameter.default_value;
    case 3:
      return std::clamp(unit(random) * 1e-12, parameter.min, parameter.max);
    case 4:
      return std::clamp(parameter.default_value + unit(random), parameter.min, parameter.max);
    default:
      return std::clamp(parameter.default_value + 0.1 * unit(random), parameter.min, parameter.max);
  }
}

TEST(CalibratedLenses, StayFiniteForAnyParameters) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  size_t tried = 0, seen = 0, lost = 0;
  for (const LensModel& model : lens_models()) {
    const bool relevant = model.info.radial && !model.info.parameters.empty();
    for (int set = 0; relevant && set < 400; ++set) {
      std::vector<double> values;
      std::string text = model.info.name;
      for (const LensParameterInfo& parameter : model.info.parameters) {
        values.push_back(parameter.choices ? double(random() % choices(parameter).size())
                                           : random_value(parameter, random));
        text += fmt::format(" {}={}", parameter.name, values.back());
      }
      const LensParameters parameters = lens_parameters(model.info, values);
      ASSERT_TRUE(parameters.max_angle >= 0.0 && parameters.max_angle <= pi) << text;
      for (int i = 0; i < 40; ++i) {
        const double scale = std::pow(10.0, 3 * unit(random));
        const glm::dvec2 plane(scale * unit(random), scale * unit(random));
        glm::dvec3 direction;
        glm::vec3 single;
        model.unproject_float(parameters, glm::vec2(plane), single);
        ++tried;
        if (!model.unproject(parameters, plane, direction)) continue;
        ++seen;
        ASSERT_NEAR(glm::length(direction), 1.0, 1e-12) << text << " at " << plane.x << ' ' << plane.y;
        glm::dvec2 back;
        // What is valid comes back, unless the formula itself has lost all digits there.
        const bool same = model.project(parameters, direction, back) &&
                          glm::distance(back, plane) <= 1e-6 * (1e-3 + glm::length(plane));
        if (!same) ++lost;
      }
    }
  }
  EXPECT_GT(seen, tried / 20);
  RecordProperty("lost", fmt::format("{} of {}", lost, seen));
  EXPECT_LT(lost, seen / 100);
}

}  // namespace
}  // namespace omma
