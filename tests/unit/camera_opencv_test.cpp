// opencv_fisheye against OpenCV's own fisheye functions, for made-up and for real calibrations.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <opencv2/calib3d.hpp>
#include <sstream>

#include "omma/base/file.h"
#include "omma/camera/camera.h"
#include "tests/places.h"

namespace omma {
namespace {

struct Calibration {
  std::string name;
  int width, height;
  double fx, fy, cx, cy;  // OpenCV's pixels: the centre of the first one is (0, 0)
  std::array<double, 4> k;
};

Camera camera_of(const Calibration& c) {
  return make_camera(fmt::format("opencv_fisheye:fx={},fy={},cx={},cy={},width={},height={},k1={},k2={},k3={},k4={}",
                                 c.fx, c.fy, c.cx + 0.5, c.cy + 0.5, c.width, c.height, c.k[0], c.k[1], c.k[2],
                                 c.k[3]));
}

cv::Matx33d matrix_of(const Calibration& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }
cv::Vec4d coefficients_of(const Calibration& c) { return {c.k[0], c.k[1], c.k[2], c.k[3]}; }

// OpenCV works on the plane z = 1 and so knows no ray at 90 degrees or beyond.
constexpr double max_degrees = 85.0;

void compare_projection(const Calibration& calibration) {
  const Camera camera = camera_of(calibration);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 5000; ++i) {
    const double theta = (i + 0.5) / 5000 * max_degrees * CV_PI / 180, turn = 2.399963 * i;
    if (theta > camera.lens()->parameters.max_angle) break;
    points.emplace_back(std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn), std::cos(theta));
  }
  ASSERT_GT(points.size(), 2000U) << calibration.name;
  std::vector<cv::Point2d> expected;
  cv::fisheye::projectPoints(points, expected, cv::Vec3d(), cv::Vec3d(), matrix_of(calibration),
                             coefficients_of(calibration));
  double worst = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto pixel = camera.project({points[i].x, -points[i].y, -points[i].z});
    ASSERT_TRUE(pixel) << calibration.name << ", point " << i;
    worst = std::max(worst, glm::distance(*pixel - 0.5, glm::dvec2(expected[i].x, expected[i].y)));
  }
  testing::Test::RecordProperty("projection " + calibration.name, fmt::format("{:.2g}", worst));
  // Observed: 3.4e-13 px.
  EXPECT_LT(worst, 1e-11) << calibration.name;
}

void compare_unprojection(const Calibration& calibration) {
  const Camera camera = camera_of(calibration);
  std::vector<cv::Point2d> pixels;
  std::vector<glm::dvec3> rays;
  for (int y = 0; y < calibration.height; y += 7) {
    for (int x = 0; x < calibration.width; x += 7) {
      const auto ray = camera.unproject({x + 0.5, y + 0.5});
      if (!ray || -ray->direction.z < std::cos(max_degrees * CV_PI / 180)) continue;
      pixels.emplace_back(x, y);
      rays.push_back(ray->direction);
    }
  }
  ASSERT_GT(pixels.size(), 2000U) << calibration.name;
  std::vector<cv::Point2d> expected;
  cv::fisheye::undistortPoints(pixels, expected, matrix_of(calibration), coefficients_of(calibration));
  double worst = 0.0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const glm::dvec3 ray = glm::normalize(glm::dvec3(expected[i].x, -expected[i].y, -1.0));
    worst = std::max(worst, glm::distance(ray, rays[i]));
  }
  testing::Test::RecordProperty("unprojection " + calibration.name, fmt::format("{:.2g}", worst));
  // OpenCV stops its own iteration at 1e-8. Observed: 9e-16.
  EXPECT_LT(worst, 1e-8) << calibration.name;
}

const Calibration made_up[] = {
    {"without distortion", 640, 480, 300, 310, 322.25, 238.75, {0, 0, 0, 0}},
    {"like TUM-VI", 512, 512, 191, 190.5, 255.1, 256.7, {0.0035, 0.0007, -0.0021, 0.0002}},
    {"strong", 960, 540, 440, 441, 480.3, 275.4, {-0.03, -0.003, -0.003, -0.0006}},
};

TEST(OpencvFisheye, ProjectsLikeOpenCV) {
  for (const Calibration& calibration : made_up) compare_projection(calibration);
}

TEST(OpencvFisheye, UnprojectsLikeOpenCV) {
  for (const Calibration& calibration : made_up) compare_unprojection(calibration);
}

// Every number after `key`, up to the end of the line.
std::vector<double> numbers_after(const std::string& text, const std::string& key) {
  const size_t begin = text.find(key);
  if (begin == std::string::npos) return {};
  std::string line = text.substr(begin + key.size(), text.find('\n', begin) - begin - key.size());
  std::ranges::replace_if(
      line, [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream stream(line);
  return {std::istream_iterator<double>(stream), {}};
}

TEST(OpencvFisheye, AgreesWithOpenCVForRealCalibrations) {
  const std::filesystem::path folder = std::filesystem::path(places::shared_data) / "calib";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  std::vector<Calibration> real;

  const std::string kalibr = read_file(folder / "tumvi_kalibr_imucam_chain.yaml");
  for (const char* name : {"cam0:", "cam1:"}) {
    const std::string camera = kalibr.substr(kalibr.find(std::string("\n") + name));
    const auto f = numbers_after(camera, "intrinsics:"), k = numbers_after(camera, "distortion_coeffs:");
    ASSERT_EQ(f.size(), 4U);
    ASSERT_EQ(k.size(), 4U);
    real.push_back({std::string("TUM-VI ") + name, 512, 512, f[0], f[1], f[2], f[3], {k[0], k[1], k[2], k[3]}});
  }
  const std::string stella = read_file(folder / "stella_aist_fisheye_kb4.yaml");
  const auto one = [&](const char* key) { return numbers_after(stella, key).at(0); };
  real.push_back({"stella",
                  960,
                  540,
                  one(" fx:"),
                  one(" fy:"),
                  one(" cx:"),
                  one(" cy:"),
                  {one(" k1:"), one(" k2:"), one(" k3:"), one(" k4:")}});
  const auto v = numbers_after(read_file(folder / "colmap_silda/cameras.txt"), "OPENCV_FISHEYE");
  ASSERT_EQ(v.size(), 10U);
  // COLMAP's principal point counts from the corner.
  real.push_back({"SILDa", 1024, 1024, v[2], v[3], v[4] - 0.5, v[5] - 0.5, {v[6], v[7], v[8], v[9]}});

  for (const Calibration& calibration : real) {
    compare_projection(calibration);
    compare_unprojection(calibration);
  }
}

}  // namespace
}  // namespace omma
