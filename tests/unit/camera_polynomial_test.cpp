// Lenses whose radius is a polynomial: how far it rises, and its inverse.
#include "omma/camera/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "omma/camera/lens_model.h"

namespace omma {
namespace {

TEST(Polynomial, FindsEveryCrossing) {
  // (x-1)(x-2)(x-3)(x-4)
  const double quartic[] = {24, -50, 35, -10, 1};
  const std::vector<double> roots = polynomial_roots(quartic, 0.0, 10.0);
  ASSERT_EQ(roots.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(roots[i], i + 1.0, 1e-13);
  EXPECT_EQ(polynomial_roots(quartic, 2.5, 3.5).size(), 1U);
  const double constant[] = {1.0, 0.0, 0.0};
  EXPECT_TRUE(polynomial_roots(constant, -1.0, 1.0).empty());
  // A pair of roots a millionth apart, which steps across the interval would miss.
  const double close[] = {0.25 - 0.25e-12, -1.0, 1.0};
  EXPECT_EQ(polynomial_roots(close, 0.0, 10.0).size(), 2U);
}

TEST(OpencvFisheye, EndsWhereItsPolynomialTurnsBack) {
  const LensModel& model = *find_lens_model("opencv_fisheye");
  LensParameters parameters;
  EXPECT_EQ(model.info.max_angle(parameters), 3.14159265358979323846);
  parameters.k[0] = -0.1;  // θ - 0.1 θ³ turns back at θ = √(1/0.3)
  EXPECT_NEAR(model.info.max_angle(parameters), std::sqrt(1.0 / 0.3), 1e-14);
  parameters.max_angle = model.info.max_angle(parameters);
  const double top = parameters.max_angle * (1 - 0.1 / 0.3);
  glm::dvec3 direction;
  EXPECT_FALSE(model.unproject(parameters, {top * (1 + 1e-9), 0.0}, direction));
  ASSERT_TRUE(model.unproject(parameters, {top * (1 - 1e-12), 0.0}, direction));
  // The end is flat: half the digits remain. Observed: 1.5e-6.
  EXPECT_NEAR(std::atan2(direction.x, direction.z), parameters.max_angle, 1e-5);
  glm::dvec2 plane;
  EXPECT_FALSE(model.project(parameters, {std::sin(2.0), 0, std::cos(2.0)}, plane));
}

TEST(OpencvFisheye, InvertsAnyPolynomialThatRises) {
  const LensModel& model = *find_lens_model("opencv_fisheye");
  uint32_t state = 1;
  const auto random = [&] {  // -1 to 1
    state = state * 1664525U + 1013904223U;
    return state / 2147483648.0 - 1.0;
  };
  double worst = 0.0, worst_theta = 0.0;
  for (int sample = 0; sample < 20000; ++sample) {
    LensParameters parameters;
    const double scale = sample % 3 == 0 ? 10.0 : sample % 3 == 1 ? 0.5 : 0.01;
    for (int i = 0; i < 4; ++i) parameters.k[i] = scale * random();
    parameters.max_angle = model.info.max_angle(parameters);
    ASSERT_GT(parameters.max_angle, 0.0);
    const double theta = parameters.max_angle * (0.5 + 0.5 * random());
    glm::dvec2 plane, back;
    glm::dvec3 direction;
    ASSERT_TRUE(model.project(parameters, {std::sin(theta), 0, std::cos(theta)}, plane));
    ASSERT_TRUE(model.unproject(parameters, plane, direction));
    ASSERT_TRUE(model.project(parameters, direction, back));
    const double error = std::abs(back.x - plane.x) / (1e-3 + plane.x);
    if (error > worst) worst = error, worst_theta = theta;
  }
  // Observed: 1.0e-15.
  EXPECT_LT(worst, 1e-13) << "at " << worst_theta;
}

}  // namespace
}  // namespace omma
