// Calibrated lenses against OpenCV's projectPoints and omnidir, and real calibrations against each other and against
// what their files say besides.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <sstream>

#include "omma/base/file.h"
#include "omma/camera/camera.h"
#include "tests/places.h"

namespace omma {
namespace {

constexpr const char* opencv_names[] = {"k1", "k2", "p1", "p2", "k3", "k4",    "k5",
                                        "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"};

struct Pinhole {
  std::string name;
  int width, height;
  double fx, fy, cx, cy;  // OpenCV's pixels: the centre of the first one is (0, 0)
  std::vector<double> coefficients;
};

Camera camera_of(const Pinhole& c) {
  std::string text = fmt::format("opencv:fx={},fy={},cx={},cy={},width={},height={}", c.fx, c.fy, c.cx + 0.5,
                                 c.cy + 0.5, c.width, c.height);
  for (size_t i = 0; i < c.coefficients.size(); ++i) text += fmt::format(",{}={}", opencv_names[i], c.coefficients[i]);
  return make_camera(text);
}

// Directions of the pixels' rays, projected by OpenCV, are the pixels again; so are directions spread over what is
// seen.
void compare_with_opencv(const Pinhole& c) {
  const Camera camera = camera_of(c);
  std::vector<glm::dvec2> pixels;
  std::vector<cv::Point3d> points;
  size_t asked = 0;
  for (int y = 0; y < c.height; y += 5) {
    for (int x = 0; x < c.width; x += 5) {
      ++asked;
      const auto ray = camera.unproject({x + 0.5, y + 0.5});
      if (!ray) continue;
      const glm::dvec3& d = ray->direction;
      const auto back = camera.project(d);
      ASSERT_TRUE(back) << c.name;
      pixels.push_back(*back);
      points.emplace_back(d.x, -d.y, -d.z);
    }
  }
  ASSERT_GT(pixels.size(), asked / 2) << c.name;
  std::vector<cv::Point2d> expected;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), cv::Matx33d(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1),
                    c.coefficients, expected);
  double worst = 0.0, worst_ray = 0.0;
  size_t i = 0;
  for (int y = 0; y < c.height; y += 5) {
    for (int x = 0; x < c.width; x += 5) {
      if (!camera.unproject({x + 0.5, y + 0.5})) continue;
      worst = std::max(worst, glm::distance(pixels[i] - 0.5, glm::dvec2(expected[i].x, expected[i].y)));
      worst_ray = std::max(worst_ray, std::hypot(expected[i].x - x, expected[i].y - y));
      ++i;
    }
  }
  testing::Test::RecordProperty("project " + c.name, fmt::format("{:.2g}", worst));
  testing::Test::RecordProperty("unproject " + c.name, fmt::format("{:.2g}", worst_ray));
  // Observed: 4.7e-13 px, both.
  EXPECT_LT(worst, 1e-11) << c.name;
  EXPECT_LT(worst_ray, 1e-11) << c.name;
}

TEST(Opencv, AgreesWithProjectPointsForEveryNumberOfCoefficients) {
  const std::vector<double> all = {-0.28, 0.07,  0.0002, 2e-5,   0.01,    0.02,  -0.003,
                                   0.002, 0.001, -0.002, 0.0015, -0.0005, 0.021, -0.034};
  for (const size_t count : {size_t{4}, size_t{5}, size_t{8}, size_t{12}, size_t{14}}) {
    compare_with_opencv({fmt::format("{} coefficients", count), 752, 480, 458.6, 457.3, 367.2, 248.4,
                         std::vector<double>(all.begin(), all.begin() + long(count))});
  }
  compare_with_opencv({"pincushion", 640, 480, 500, 510, 322, 238, {0.2, -0.05, -0.004, 0.003, 0.1}});
  compare_with_opencv({"rational", 640, 480, 400, 401, 322, 238, {6.2, 3.1, 0.0001, -0.0002, 0.12, 6.5, 4.9, 0.74}});
  compare_with_opencv({"tilted", 640, 480, 400, 401, 322, 238, {-0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.3, -0.2}});
}

// OpenCV 4.6's cv::omnidir::projectPoints is in its contributed modules; these are pixels that it gave.
TEST(Mei, ProjectsLikeOpencvsOmnidir) {
  struct Case {
    const char* camera;
    std::vector<std::pair<glm::dvec3, glm::dvec2>> points;
  };
  const Case cases[] = {
      {"mei:fx=2138.7619122017772,fy=2131.5886210259278,cx=361.69856633263799,cy=248.77644773395667,width=752,"
       "height=480,xi=3.6313355285286337,k1=1.1757726639872075,k2=15.491281051140213,p1=-0.00081237172954550494,"
       "p2=0.00067297684030310243",
       {{{0.1, 0.2, 1}, {406.62603841332117, 338.81634839009405}},
        {{-0.5, 0.3, 1}, {152.21750768047866, 373.23360017691624}},
        {{0.6, -0.4, 1}, {601.45072609525846, 88.632096718113303}},
        {{0, 0, 1}, {361.19856633263799, 248.27644773395667}}}},
      {"mei:fx=500,fy=510,cx=320.5,cy=240.5,width=640,height=480,xi=0.9,k1=-0.2,k2=0.05,p1=0.001,p2=-0.002",
       {{{0.1, 0.2, 1}, {345.9278241270855, 292.9272677648737}},
        {{-0.5, 0.3, 1}, {199.27942336256297, 313.87267446154215}},
        {{0.6, -0.4, 1}, {458.64873287110532, 145.69899821566878}},
        {{2, 1, -0.3}, {781.77565858824255, 477.20864885616561}},
        {{-1, 3, 0.2}, {180.28826037856513, 664.77984301156789}}}},
  };
  for (const Case& c : cases) {
    const Camera camera = make_camera(c.camera);
    for (const auto& [point, expected] : c.points) {
      const auto pixel = camera.project({point.x, -point.y, -point.z});
      ASSERT_TRUE(pixel) << c.camera << " at " << expected.x;
      // Observed: 2e-13 px.
      EXPECT_LT(glm::distance(*pixel - 0.5, expected), 1e-11);
      const auto ray = camera.unproject(*pixel);
      ASSERT_TRUE(ray);
      EXPECT_LT(glm::distance(ray->direction, glm::normalize(point * glm::dvec3(1, -1, -1))), 1e-13);
    }
  }
}

class RealCalibrations : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is absent";
  }

  std::string text(const char* name) const { return read_file(folder_ / name); }
  nlohmann::json json(const char* name) const { return nlohmann::json::parse(text(name)); }

  // Every number after `key`, up to the end of the line.
  static std::vector<double> numbers_after(const std::string& text, const std::string& key) {
    const size_t begin = text.find(key);
    if (begin == std::string::npos) return {};
    std::string line = text.substr(begin + key.size(), text.find('\n', begin) - begin - key.size());
    std::ranges::replace_if(
        line, [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
    std::istringstream stream(line);
    return {std::istream_iterator<double>(stream), {}};
  }

 private:
  const std::filesystem::path folder_ = std::filesystem::path(places::shared_data) / "calib";
};

// How far apart two calibrations of one camera see a pixel's ray, in pixels of the second: mean over the pixels that
// both see within `max_deg` of the axis.
double mean_difference(const Camera& a, const Camera& b, double max_deg) {
  double sum = 0.0;
  size_t count = 0, asked = 0;
  for (int y = 0; y < a.size().height; y += 4) {
    for (int x = 0; x < a.size().width; x += 4) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const auto ray = a.unproject(pixel);
      if (!ray || -ray->direction.z < std::cos(max_deg * CV_PI / 180)) continue;
      ++asked;
      const auto other = b.project(ray->direction);
      if (!other) continue;
      ++count;
      sum += glm::distance(*other, pixel);
    }
  }
  EXPECT_GT(count, 2000U);
  EXPECT_EQ(count, asked);
  return sum / double(count);
}

TEST_F(RealCalibrations, OfTumViBasaltsTwoModelsAndKalibrsAgree) {
  const auto camera = [&](const char* file, const char* lens, int index) {
    const nlohmann::json entry = json(file)["value0"]["intrinsics"][size_t(index)]["intrinsics"];
    std::string text = fmt::format("{}:width=512,height=512", lens);
    for (const auto& [key, value] : entry.items()) {
      const bool centre = key == "cx" || key == "cy";
      text += fmt::format(",{}={}", key, value.get<double>() + (centre ? 0.5 : 0.0));
    }
    return make_camera(text);
  };
  const std::string kalibr = text("tumvi_kalibr_imucam_chain.yaml");
  for (const int index : {0, 1}) {
    const Camera ds = camera("basalt_tumvi_512_ds.json", "ds", index);
    const Camera eucm = camera("basalt_tumvi_512_eucm.json", "eucm", index);
    const std::string part = kalibr.substr(kalibr.find(fmt::format("\ncam{}:", index)));
    const auto f = numbers_after(part, "intrinsics:"), k = numbers_after(part, "distortion_coeffs:");
    ASSERT_EQ(f.size() + k.size(), 8U);
    const Camera kb4 =
        make_camera(fmt::format("kb4:fx={},fy={},cx={},cy={},width=512,height=512,k1={},k2={},k3={},k4={}", f[0], f[1],
                                f[2] + 0.5, f[3] + 0.5, k[0], k[1], k[2], k[3]));
    const double eucm_px = mean_difference(ds, eucm, 85), kb4_px = mean_difference(ds, kb4, 85);
    RecordProperty(fmt::format("cam{}", index), fmt::format("eucm {:.2g} px, kb4 {:.2g} px", eucm_px, kb4_px));
    // Observed: 0.010 px and 0.35 px.
    EXPECT_LT(eucm_px, 0.05);
    EXPECT_LT(kb4_px, 1.0);
  }
}

TEST_F(RealCalibrations, OfEurocKalibrsRadtanAndCamodocalsMeiAgree) {
  const std::string kalibr = text("euroc_kalibr_imucam_chain.yaml");
  const auto f = numbers_after(kalibr, "intrinsics:"), d = numbers_after(kalibr, "distortion_coeffs:");
  ASSERT_EQ(f.size(), 4U);
  ASSERT_EQ(d.size(), 4U);
  const Pinhole pinhole{"EuRoC", 752, 480, f[0], f[1], f[2], f[3], d};
  compare_with_opencv(pinhole);
  const std::string mei = text("vins_euroc_cam0_mei.yaml");
  const auto one = [&](const char* key) { return numbers_after(mei, key).at(0); };
  const Camera other = make_camera(fmt::format(
      "mei:fx={},fy={},cx={},cy={},width=752,height=480,xi={},k1={},k2={},p1={},p2={}", one("gamma1:"), one("gamma2:"),
      one("u0:") + 0.5, one("v0:") + 0.5, one("xi:"), one("k1:"), one("k2:"), one("p1:"), one("p2:")));
  // They differ by how the camera was turned too, which a calibration cannot tell from its principal point.
  const double px = mean_difference(camera_of(pinhole), other, 35);
  RecordProperty("mean", fmt::format("{:.2g} px", px));
  // Observed: 6 px.
  EXPECT_LT(px, 10.0);
}

TEST_F(RealCalibrations, OfOcamCalibBothPolynomialsAgree) {
  std::istringstream file(text("ocam_calib_results_0.txt"));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream stream(line);
    const std::vector<double> row{std::istream_iterator<double>(stream), {}};
    if (!row.empty()) rows.push_back(row);
  }
  ASSERT_EQ(rows.size(), 5U);
  const auto& [direct, inverse, centre, affine, size] = std::tie(rows[0], rows[1], rows[2], rows[3], rows[4]);
  ASSERT_EQ(direct[0], 5);
  const Camera camera =
      make_camera(fmt::format("ocam:f=1,cx={},cy={},width={},height={},a0={},a1={},a2={},a3={},a4={},c={},d={},e={}",
                              centre[1] + 0.5, centre[0] + 0.5, size[1], size[0], direct[1], direct[2], direct[3],
                              direct[4], direct[5], affine[0], affine[1], affine[2]));
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double theta = (i + 0.5) / 2000 * 1.65, turn = 2.399963 * i;
    const glm::dvec3 optical(std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn), std::cos(theta));
    const auto pixel = camera.project({optical.x, -optical.y, -optical.z});
    ASSERT_TRUE(pixel) << theta;
    // As world2cam has it: rows first, the angle from the image plane, which is negative in front.
    double rho = 0.0;
    for (size_t k = inverse.size() - 1; k >= 1; --k) rho = rho * (theta - CV_PI / 2) + inverse[k];
    const double row = std::sin(turn) * rho, column = std::cos(turn) * rho;
    const glm::dvec2 expected(row * affine[2] + column + centre[1], row * affine[0] + column * affine[1] + centre[0]);
    worst = std::max(worst, glm::distance(*pixel - 0.5, expected));
  }
  RecordProperty("worst", fmt::format("{:.2g} px", worst));
  // How well OCamCalib fitted the one to the other. Observed: 0.006 px.
  EXPECT_LT(worst, 0.05);
}

TEST_F(RealCalibrations, OfNvidiaBothPolynomialsAgree) {
  const nlohmann::json rig = json("nvidia_ftheta_rig.json");
  for (const auto& [name, entry] : rig.items()) {
    const nlohmann::json& in = entry["intrinsics"];
    const auto camera = [&](const char* polynomial, const char* reference) {
      std::string text = fmt::format("ftheta:f=1,cx={},cy={},width={},height={},reference={},c={},d={},e={}",
                                     in["principal_point"][0].get<double>(), in["principal_point"][1].get<double>(),
                                     entry["resolution"][0].get<int>(), entry["resolution"][1].get<int>(), reference,
                                     in["linear_cde"][0].get<double>(), in["linear_cde"][1].get<double>(),
                                     in["linear_cde"][2].get<double>());
      EXPECT_EQ(in[polynomial][0].get<double>(), 0.0);
      for (size_t i = 1; i < 6; ++i) text += fmt::format(",k{}={}", i, in[polynomial][i].get<double>());
      return make_camera(text);
    };
    const Camera forward = camera("angle_to_pixeldist_poly", "angle_to_pixeldist");
    const Camera backward = camera("pixeldist_to_angle_poly", "pixeldist_to_angle");
    const double max_angle = in["max_angle_rad"].get<double>();
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double theta = (i + 0.5) / 2000 * max_angle, turn = 2.399963 * i;
      const glm::dvec3 d(std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn), -std::cos(theta));
      const auto a = forward.project(d), b = backward.project(d);
      ASSERT_TRUE(a && b) << name << " at " << theta << " of " << max_angle;
      worst = std::max(worst, glm::distance(*a, *b));
    }
    RecordProperty(name, fmt::format("{:.2g} px", worst));
    // Observed: 0.22 px.
    EXPECT_LT(worst, 1.0) << name;
  }
}

TEST_F(RealCalibrations, OfWoodScapeReachBeyondTheHemisphere) {
  const nlohmann::json in = json("woodscape_front.json")["intrinsic"];
  const auto k = [&](const char* key) { return in[key].get<double>(); };
  const Camera camera = make_camera(fmt::format("woodscape:f=1,cx={},cy={},width={},height={},k1={},k2={},k3={},k4={}",
                                                k("width") / 2 + k("cx_offset"), k("height") / 2 + k("cy_offset"),
                                                k("width"), k("height"), k("k1"), k("k2"), k("k3"), k("k4")));
  const double theta = 1.6;
  const auto pixel = camera.project({std::sin(theta), 0, -std::cos(theta)});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 643.942 + 339.749 * 1.6 - 31.988 * 2.56 + 48.275 * 4.096 - 7.201 * 6.5536, 1e-9);
}

}  // namespace
}  // namespace omma
