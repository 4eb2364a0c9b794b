// What nonlinear believes of cameras: how far curved edges may lie from straight ones, and which rays lie in which
// cone.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>
#include <random>
#include <string>

#include "omma/technique/nonlinear/image_squares.h"
#include "omma/technique/nonlinear/lens_curvature.h"
#include "tests/proof.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

/// Ten million over all lenses are the full proof.
size_t cases_per_camera(size_t few) { return full_proof() ? 10000000 / (6 * lens_models().size()) : few; }

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? glm::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// 0 inside.
double distance_to_triangle(const glm::dvec2& p, const std::array<glm::dvec2, 3>& corners) {
  int left = 0, right = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = corners[i], b = corners[(i + 1) % 3];
    nearest = std::min(nearest, distance_to_segment(p, a, b));
    (cross(b - a, p - a) < 0.0 ? left : right) += 1;
  }
  return left == 0 || right == 0 ? 0.0 : nearest;
}

class NonlinearLensTest : public ::testing::TestWithParam<size_t> {
 protected:
  const LensModel& model() const { return lens_models()[GetParam()]; }
};

// A pixel sees a point of a triangle around its ray; the straight triangle between the projected corners, enlarged by
// the bound, must contain the pixel.
TEST_P(NonlinearLensTest, CurvedTrianglesStayWithinTheirBounds) {
  std::mt19937_64 random(GetParam());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  size_t bounded = 0, cases = 0, outside = 0;
  double worst = 0.0, used = 0.0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    const Lens& lens = *camera.lens();
    const Lens wide = LensCurvature::without_limit(lens);
    const LensCurvature curvature(lens);
    for (size_t i = 0; i < cases_per_camera(2000); ++i) {
      const glm::dvec2 pixel(unit(random) * lens.size.width, unit(random) * lens.size.height);
      const auto ray = lens.unproject(pixel);
      if (!ray) continue;
      ++cases;
      // Corners around the ray: its weights in them are positive.
      const double size = 1e-3 * std::pow(400.0, unit(random));
      const glm::dvec3 side = std::abs(ray->x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
      const glm::dvec3 u = glm::normalize(glm::cross(*ray, side)), v = glm::cross(*ray, u);
      std::array<glm::dvec2, 3> offsets;
      for (glm::dvec2& offset : offsets) offset = glm::dvec2(unit(random), unit(random)) - 0.5;
      const glm::dvec3 weights(0.02 + unit(random), 0.02 + unit(random), 0.02 + unit(random));
      const glm::dvec2 mean = (weights.x * offsets[0] + weights.y * offsets[1] + weights.z * offsets[2]) /
                              (weights.x + weights.y + weights.z);
      std::array<glm::dvec3, 3> corners;
      for (size_t c = 0; c < 3; ++c) {
        const glm::dvec2 at = size * (offsets[c] - mean);
        corners[c] = glm::normalize(*ray + at.x * u + at.y * v);
      }
      const glm::dvec3 axis = glm::normalize(corners[0] + corners[1] + corners[2]);
      double radius = 0.0, edge = 0.0;
      std::array<glm::dvec2, 3> image;
      bool seen = true;
      for (size_t c = 0; c < 3; ++c) {
        radius = std::max(radius, angle_between(axis, corners[c]));
        edge = std::max(edge, angle_between(corners[c], corners[(c + 1) % 3]));
        const auto at = wide.project(corners[c]);
        seen &= at.has_value();
        if (at) image[c] = *at;
      }
      const Curvature bound = curvature.around(axis, radius);
      const double bulge = bound.deviation_px(float(edge));
      if (!seen || !std::isfinite(bulge) || bound.turn(float(edge)) >= 0.5f) continue;
      ++bounded;
      const double off = distance_to_triangle(pixel, image);
      if (off > bulge + 1e-4) {
        ++outside;
        worst = std::max(worst, off - bulge);
      }
      if (bulge > 1e-3) used = std::max(used, off / bulge);
    }
  }
  RecordProperty("bounded_percent", std::to_string(100.0 * double(bounded) / double(cases)));
  std::cout << fmt::format("{}: {} of {} triangles have bounds, which are used up to {:.2f}\n", model().info.name,
                           bounded, cases, used);
  EXPECT_EQ(outside, 0u) << "by up to " << worst << " px";
  EXPECT_GT(cases, 2000u);
}

TEST_P(NonlinearLensTest, SquaresKnowTheRaysOfTheirPixels) {
  std::mt19937_64 random(GetParam());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  size_t rays = 0, uncovered = 0, outside = 0, not_linear = 0, not_whole = 0, linear = 0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    const ImageSize size = camera.size();
    const PixelRect tile{16, 8, size.width, size.height - 3};
    for (const bool shifted : {false, true}) {
      const std::vector<ImageSquare> squares = image_squares(camera, tile, shifted);
      std::vector<char> covered(size_t(tile.width()) * size_t(tile.height()));
      for (const ImageSquare& square : squares) {
        for (int i = 0; i < 4; ++i) {
          const glm::dvec2 pixel = glm::floor(glm::dvec2(square.x, square.y) +
                                              double(square.side) * glm::dvec2(unit(random), unit(random))) +
                                   glm::dvec2(tile.x0, tile.y0);
          if (pixel.x >= tile.x1 || pixel.y >= tile.y1) continue;
          // A pixel's samples, and its pass's shift; a pixel whose centre sees nothing is never drawn.
          const glm::dvec2 shift = shifted ? glm::dvec2(unit(random), unit(random)) - 0.5 : glm::dvec2(0.0);
          const glm::dvec2 sample = glm::dvec2(0.05) + 0.9 * glm::dvec2(unit(random), unit(random));
          const auto ray = camera.unproject(pixel + sample + shift);
          not_whole += square.whole && !camera.unproject(pixel + 0.5);
          if (!ray || !camera.unproject(pixel + 0.5 + shift)) continue;
          ++rays;
          outside += angle_between(square.cone.axis, ray->direction) > square.cone.angle + 1e-7;
          if (!square.linear) continue;
          const glm::dvec2 corner = glm::dvec2(square.x + tile.x0, square.y + tile.y0);
          const glm::dvec2 uv = 2.0 * (pixel + sample + shift - corner) / double(square.side) - 1.0;
          const glm::dvec3 near = square.linear->middle + uv.x * square.linear->across + uv.y * square.linear->down;
          const double along = glm::dot(near, ray->direction);
          not_linear += along <= 0.0 || glm::distance(near, along * ray->direction) > square.linear->off;
          ++linear;
        }
        if (square.descendants > 0) continue;
        for (int y = square.y; y < std::min(square.y + square.side, tile.height()); ++y) {
          for (int x = square.x; x < std::min(square.x + square.side, tile.width()); ++x) {
            ++covered[size_t(y) * size_t(tile.width()) + size_t(x)];
          }
        }
      }
      for (int y = 0; y < tile.height(); ++y) {
        for (int x = 0; x < tile.width(); ++x) {
          const int times = covered[size_t(y) * size_t(tile.width()) + size_t(x)];
          EXPECT_LE(times, 1);
          uncovered += times == 0 && camera.unproject(glm::dvec2(x + tile.x0, y + tile.y0) + 0.5).has_value();
        }
      }
    }
  }
  EXPECT_EQ(outside, 0u) << "of " << rays;
  EXPECT_EQ(not_linear, 0u) << "of " << linear;
  EXPECT_EQ(not_whole, 0u);
  EXPECT_EQ(uncovered, 0u);
  EXPECT_GT(linear, rays / 20);
  EXPECT_GT(rays, 10000u);
}

INSTANTIATE_TEST_SUITE_P(Lenses, NonlinearLensTest, ::testing::Range<size_t>(0, lens_models().size()),
                         [](const auto& tested) { return std::string(lens_models()[tested.param].info.name); });

}  // namespace
}  // namespace omma
