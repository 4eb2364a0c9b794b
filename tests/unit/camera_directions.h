// Directions by longitude and latitude, and how a lens scales the world there.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "omma/camera/lens_model.h"

namespace omma {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double radians(double deg) { return deg * pi / 180.0; }

// In the camera frame.
inline glm::dvec3 direction_at(double longitude_deg, double latitude_deg) {
  const double a = radians(longitude_deg), b = radians(latitude_deg);
  return {std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b)};
}

inline glm::dvec3 optical(const glm::dvec3& camera) { return {camera.x, -camera.y, -camera.z}; }

inline std::vector<const LensModel*> models_of(const char* group) {
  std::vector<const LensModel*> models;
  for (const LensModel& model : lens_models()) {
    if (std::string_view(model.info.group) == group) models.push_back(&model);
  }
  return models;
}

// The derivatives of the plane's point along the parallel and the meridian, by the unit of arc.
inline std::array<glm::dvec2, 2> scales(const LensModel& model, const LensParameters& parameters, double longitude_deg,
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

}  // namespace omma
