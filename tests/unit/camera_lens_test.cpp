// The mathematics of every lens: round trips, values worked out by hand, symmetry, seams and poles, single precision.
#include "omma/camera/lens_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "omma/camera/camera.h"
#include "tests/proof.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radians(double deg) { return deg * pi / 180.0; }

class EveryLens : public testing::TestWithParam<const LensModel*> {
 protected:
  const LensModel& model() const { return *GetParam(); }
  const LensInfo& info() const { return model().info; }
  /// Faces or circles side by side: neither symmetric nor continuous.
  bool is_layout() const { return std::string_view(info().group) == "layout"; }
};

std::vector<const LensModel*> all_models() {
  std::vector<const LensModel*> models;
  for (const LensModel& model : lens_models()) models.push_back(&model);
  return models;
}

INSTANTIATE_TEST_SUITE_P(Camera, EveryLens, testing::ValuesIn(all_models()),
                         [](const auto& lens) { return std::string(lens.param->info.name); });

// The largest error of a test and where it was found.
struct Worst {
  double error = 0.0;
  std::string where;
  size_t count = 0;

  void add(double candidate, const std::string& camera, const glm::dvec2& pixel) {
    ++count;
    if (candidate <= error) return;
    error = candidate;
    where = fmt::format("{} at pixel ({}, {})", camera, pixel.x, pixel.y);
  }
};

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// What the lens looks along, in the camera frame.
glm::dvec3 axis_of(const Camera& camera) { return -camera.lens()->cameraFromLens[2]; }

double angle_from_axis(const glm::dvec3& optical) { return std::atan2(std::hypot(optical.x, optical.y), optical.z); }

glm::dvec2 plane_of(const Lens& lens, const glm::dvec2& pixel) { return (pixel - lens.centre) / lens.focal; }

// Those of the day, or all; returns how many.
template <typename Visit>
size_t for_each_pixel(const ImageSize& size, Visit visit) {
  size_t count = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (!is_proved_today(size_t(y), size_t(x), proof_days)) continue;
      visit(glm::dvec2(x + 0.5, y + 0.5));
      ++count;
    }
  }
  return count;
}

// Pixels between two points of the plane, or what the angle between their rays amounts to where that is less: next to a
// pole all longitudes are one ray, and layouts show parts of the world twice.
double pixel_error(const Lens& lens, const glm::dvec2& a, const glm::dvec2& b) {
  const double apart = glm::length(lens.focal * (a - b));
  // A point on the very edge may have a ray only just inside.
  const auto ray_at = [&](const glm::dvec2& point, glm::dvec3& ray) {
    return lens.model->unproject(lens.parameters, point, ray) ||
           lens.model->unproject(lens.parameters, (1.0 - 1e-6) * point, ray);
  };
  glm::dvec3 ray_a, ray_b;
  if (!ray_at(a, ray_a) || !ray_at(b, ray_b)) return apart;
  return std::min(apart, angle_between(ray_a, ray_b) * std::max(lens.focal.x, lens.focal.y));
}

TEST_P(EveryLens, ProjectsBackToThePixelItWasUnprojectedFrom) {
  Worst worst;
  size_t pixels = 0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    const double max_angle = camera.lens()->parameters.max_angle;
    pixels += for_each_pixel(camera.size(), [&](const glm::dvec2& pixel) {
      const auto ray = camera.unproject(pixel);
      if (!ray) return;
      ASSERT_NEAR(glm::length(ray->direction), 1.0, 1e-14) << text;
      const auto back = camera.project(ray->direction);
      const double theta = angle_between(ray->direction, axis_of(camera));
      if (!back && theta > max_angle - 1e-9) return;  // the very edge
      ASSERT_TRUE(back) << text << " at pixel " << pixel.x << ", " << pixel.y;
      const Lens& lens = *camera.lens();
      worst.add(
          is_layout() ? pixel_error(lens, plane_of(lens, *back), plane_of(lens, pixel)) : glm::distance(*back, pixel),
          text, pixel);
    });
  }
  RecordProperty("worst", fmt::format("{:.2g} px, {}", worst.error, worst.where));
  EXPECT_GT(worst.count, pixels / 3);
  // Observed: 1.0e-12 px (fisheye624), in an image of 1408 x 1408.
  EXPECT_LT(worst.error, 5e-12) << worst.where;
}

TEST_P(EveryLens, ProjectsBackInSinglePrecision) {
  Worst worst;
  size_t pixels = 0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    const Lens& lens = *camera.lens();
    pixels += for_each_pixel(lens.size, [&](const glm::dvec2& pixel) {
      const glm::vec2 plane(plane_of(lens, pixel));
      glm::vec3 direction;
      if (!model().unproject_float(lens.parameters, plane, direction)) return;
      glm::vec2 back;
      const bool seen = model().project_float(lens.parameters, direction, back);
      if (!seen && angle_from_axis(direction) > lens.parameters.max_angle - 1e-6) return;
      ASSERT_TRUE(seen) << text << " at pixel " << pixel.x << ", " << pixel.y;
      worst.add(pixel_error(lens, back, plane), text, pixel);
    });
  }
  RecordProperty("worst", fmt::format("{:.2g} px, {}", worst.error, worst.where));
  EXPECT_GT(worst.count, pixels / 3);
  // Observed: 3.8e-4 px (fisheye624), in an image of 1408 x 1408.
  EXPECT_LT(worst.error, 5e-4) << worst.where;
}

TEST_P(EveryLens, AgreesInSingleAndDoublePrecision) {
  Worst unprojected, projected;
  size_t disagreements = 0, pixels = 0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    const Lens& lens = *camera.lens();
    pixels += for_each_pixel(lens.size, [&](const glm::dvec2& pixel) {
      const glm::dvec2 plane = plane_of(lens, pixel);
      glm::dvec3 exact;
      glm::vec3 single;
      const bool exact_valid = model().unproject(lens.parameters, plane, exact);
      const bool single_valid = model().unproject_float(lens.parameters, glm::vec2(plane), single);
      glm::vec2 single_plane;
      const bool seen = exact_valid && model().project_float(lens.parameters, glm::vec3(exact), single_plane);
      if (exact_valid != single_valid || exact_valid != seen) ++disagreements;
      if (!seen || !single_valid) return;
      projected.add(pixel_error(lens, single_plane, plane), text, pixel);
      // The single-precision ray as the exact lens sees it.
      glm::dvec2 found;
      if (!model().project(lens.parameters, glm::dvec3(single), found)) return;
      unprojected.add(pixel_error(lens, found, plane), text, pixel);
    });
  }
  RecordProperty("worst_unprojected", fmt::format("{:.2g} px, {}", unprojected.error, unprojected.where));
  RecordProperty("worst_projected", fmt::format("{:.2g} px, {}", projected.error, projected.where));
  EXPECT_GT(unprojected.count, pixels / 3);
  EXPECT_LE(disagreements, 4U);  // at the very edge of what is seen
  // Observed: 3.2e-4 px and 3.3e-4 px (fisheye624), in an image of 1408 x 1408.
  EXPECT_LT(unprojected.error, 5e-4) << unprojected.where;
  EXPECT_LT(projected.error, 5e-4) << projected.where;
}

TEST_P(EveryLens, IsSymmetric) {
  if (is_layout()) GTEST_SKIP() << "a layout";
  // The horizon divides a conic, and lenses that treat ground and sky in different ways.
  const std::set<std::string_view> only_sideways = {"albers", "lambert_conformal_conic", "architectural", "panini",
                                                    "panini_general"};
  size_t count = 0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    if (info().skewed && text == info().example) continue;
    const LensParameters& parameters = camera.lens()->parameters;
    for (int i = 0; i < 2000; ++i) {
      // Directions all over the sphere (golden angle spiral).
      const double z = 1.0 - (2.0 * i + 1.0) / 2000.0, rho = std::sqrt(1.0 - z * z), turn = 2.399963 * i;
      const glm::dvec3 direction(rho * std::cos(turn), rho * std::sin(turn), z);
      glm::dvec2 plane, mirrored;
      const bool seen = model().project(parameters, direction, plane);
      ASSERT_EQ(model().project(parameters, direction * glm::dvec3(-1, 1, 1), mirrored), seen) << text;
      if (!seen) continue;
      ++count;
      const double scale = 1.0 + glm::length(plane);
      EXPECT_NEAR(mirrored.x, -plane.x, 1e-13 * scale) << text;
      EXPECT_NEAR(mirrored.y, plane.y, 1e-13 * scale) << text;
      if (only_sideways.contains(info().name)) continue;
      ASSERT_TRUE(model().project(parameters, direction * glm::dvec3(1, -1, 1), mirrored)) << text;
      EXPECT_NEAR(mirrored.x, plane.x, 1e-13 * scale) << text;
      EXPECT_NEAR(mirrored.y, -plane.y, 1e-13 * scale) << text;
      if (!info().radial) continue;
      const glm::dvec3 turned(-direction.y, direction.x, direction.z);
      ASSERT_TRUE(model().project(parameters, turned, mirrored)) << text;
      EXPECT_NEAR(mirrored.x, -plane.y, 1e-13 * scale) << text;
      EXPECT_NEAR(mirrored.y, plane.x, 1e-13 * scale) << text;
    }
  }
  EXPECT_GT(count, 1000U);
}

TEST_P(EveryLens, HasItsAxisAtThePrincipalPointAndYUp) {
  if (is_layout()) GTEST_SKIP() << "a layout";
  for (const auto& [text, camera] : sample_cameras(model())) {
    const glm::dvec2 centre = camera.lens()->centre;
    const auto axis = camera.unproject(centre);
    ASSERT_TRUE(axis) << text;
    EXPECT_LT(glm::distance(axis->direction, axis_of(camera)), 1e-15) << text;
    EXPECT_EQ(axis->origin, glm::dvec3(0.0)) << text;
    const glm::dmat3& cameraFromLens = camera.lens()->cameraFromLens;
    EXPECT_GT(glm::dot(camera.unproject(centre + glm::dvec2(1, 0))->direction, cameraFromLens[0]), 0.0) << text;
    EXPECT_GT(glm::dot(camera.unproject(centre - glm::dvec2(0, 1))->direction, cameraFromLens[1]), 0.0) << text;
  }
}

TEST_P(EveryLens, SeesTheSameWhateverTheLengthOfADirection) {
  const Camera camera = make_camera(info().example);
  const glm::dvec3 direction(0.2, -0.1, -1.0);
  const auto pixel = camera.project(direction);
  ASSERT_TRUE(pixel);
  for (const double length : {1e-300, 1e-3, 1e10, 1e300}) {
    const auto other = camera.project(direction * length);
    ASSERT_TRUE(other) << length;
    EXPECT_LT(glm::distance(*other, *pixel), 1e-10) << length;
  }
}

TEST_P(EveryLens, SaysNothingRatherThanNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Camera camera = make_camera(info().example);
  for (const double bad : {nan, inf, -inf}) {
    for (int i = 0; i < 3; ++i) {
      glm::dvec3 direction(0.1, 0.1, -1.0);
      direction[i] = bad;
      EXPECT_FALSE(camera.project(direction)) << bad;
    }
    EXPECT_FALSE(camera.unproject({bad, 5.0})) << bad;
    EXPECT_FALSE(camera.unproject({5.0, bad})) << bad;
  }
  EXPECT_FALSE(camera.project({0, 0, 0}));
  EXPECT_FALSE(camera.unproject({1e300, 0.0}));
}

TEST_P(EveryLens, IsFiniteWhereverItIsValid) {
  size_t valid = 0;
  for (const auto& [text, camera] : sample_cameras(model())) {
    // The axes, their neighbours one rounding away, and combinations.
    const double values[] = {0.0, -0.0, 1e-300, -1e-300, 1e-17, -1e-17, 1e-9, -1e-9, 1.0, -1.0};
    for (const double x : values) {
      for (const double y : values) {
        for (const double z : values) {
          const auto pixel = camera.project({x, y, z});
          if (!pixel) continue;
          ++valid;
          ASSERT_TRUE(std::isfinite(pixel->x) && std::isfinite(pixel->y)) << text;
          const auto back = camera.unproject(*pixel);
          if (!back) continue;  // beyond the edge by rounding
          // Observed: 4.2e-8 at the flat ends of sin θ and of 2 sin(θ/2), else below 1e-14.
          EXPECT_LT(angle_between(back->direction, glm::normalize(glm::dvec3(x, y, z) /
                                                                  std::max({std::abs(x), std::abs(y), std::abs(z)}))),
                    1e-7)
              << text << " for " << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
  EXPECT_GT(valid, 500U);
}

TEST_P(EveryLens, ShowsTheAntipodeOfAFullFieldOfView) {
  if (widest_fov_deg(info()) < 360) GTEST_SKIP() << "does not reach it";
  const Camera camera = make_camera(fmt::format("{}:fov_deg=360,width=400,height=400", info().name));
  const auto pixel = camera.project({0, 0, 1});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 400.0, 1e-9);
  EXPECT_NEAR(pixel->y, 200.0, 1e-9);
  for (const glm::dvec2& edge : {glm::dvec2(1e-9, 200.0), glm::dvec2(400.0 - 1e-9, 200.0)}) {
    const auto ray = camera.unproject(edge);
    ASSERT_TRUE(ray);
    // Observed: 6.3e-6 (equisolid, which is flat there), else 1.6e-11.
    EXPECT_LT(angle_between(ray->direction, {0, 0, 1}), 1e-5);
  }
}

TEST(Panoramas, MeetAtTheSeam) {
  for (const char* name : {"cylinder", "equirectangular"}) {
    const Camera camera = make_camera(fmt::format("{}:fov_deg=360,width=800,height=400", name));
    EXPECT_NEAR(camera.project({-1e-9, 0, 1})->x, 0.0, 1e-6) << name;
    EXPECT_NEAR(camera.project({1e-9, 0, 1})->x, 800.0, 1e-6) << name;
    EXPECT_NEAR(camera.project({0, 0, 1})->x, 800.0, 1e-9) << name;
    EXPECT_FALSE(camera.unproject({-0.01, 200.0})) << name;
    EXPECT_FALSE(camera.unproject({800.01, 200.0})) << name;
  }
}

TEST(Panoramas, ShowThePolesOrNot) {
  const Camera equirectangular = make_camera("equirectangular:width=800,height=400");
  EXPECT_NEAR(equirectangular.project({0, 1, 0})->y, 0.0, 1e-9);
  EXPECT_NEAR(equirectangular.project({0, -1, 0})->y, 400.0, 1e-9);
  EXPECT_NEAR(equirectangular.project({0, 1, 0})->x, 400.0, 1e-9);
  EXPECT_FALSE(equirectangular.unproject({400.0, -0.01}));
  const Camera cylinder = make_camera("cylinder:width=800,height=400");
  EXPECT_FALSE(cylinder.project({0, 1, 0}));
  EXPECT_FALSE(cylinder.project({1e-9, -1, 0}));
  EXPECT_TRUE(cylinder.project({1e-3, 1, 0}));
}

}  // namespace
}  // namespace omma
