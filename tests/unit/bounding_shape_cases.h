// Triangles and cameras that bounding shapes are tried with.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "omma/camera/bounds/lens_bound.h"
#include "tests/unit/camera_samples.h"

namespace omma {

/// As technique nonlinear has it.
inline constexpr double margin_px = 0.0625;

struct BoundedCamera {
  std::string text;
  Lens lens;
  LensBound bound;
};

/// Lenses whose lines bend away from the axis, everywhere or towards the border.
inline constexpr const char* bending_away[] = {
    "opencv:f=150,k1=0.2,width=321,height=240",
    "opencv:f=120,k1=-0.1,k2=0.1,width=321,height=240",
    "polynomial:f=40,k1=1,k3=0.4,k5=0.1,width=321,height=240",
    "polynomial:f=30,k1=0.5,k2=0.5,width=240,height=321",
    "polynomial:f=50,k1=1,k2=0.3,k3=0.2,width=321,height=240,yaw_deg=50",
};

/// Every sample camera whose lens the shapes are made for, and those.
inline const std::vector<BoundedCamera>& bounded_cameras() {
  static const std::vector<BoundedCamera> cameras = [] {
    std::vector<BoundedCamera> list;
    for (const LensModel& model : lens_models()) {
      for (const SampleCamera& sample : sample_cameras(model)) {
        const auto bound = lens_bound(*sample.camera.lens(), margin_px);
        if (bound) list.push_back({sample.text, *sample.camera.lens(), *bound});
      }
    }
    for (const char* text : bending_away) {
      const Camera camera = make_camera(text);
      const auto bound = lens_bound(*camera.lens(), margin_px);
      EXPECT_TRUE(bound && bound->lines == Lines::any) << text;
      if (bound) list.push_back({text, *camera.lens(), *bound});
    }
    return list;
  }();
  return cameras;
}

/// From far to around the centre, from specks to what encloses it, slivers among them.
class RandomTriangles {
 public:
  std::array<glm::vec3, 3> next() {
    const double spread = std::pow(10.0, uniform(-3.0, 0.7));
    const glm::dvec3 middle = direction();
    std::array<glm::vec3, 3> corners;
    for (glm::vec3& corner : corners) {
      corner = glm::vec3((middle + spread * direction()) * std::pow(10.0, uniform(-0.5, 0.5)));
    }
    if (uniform(0.0, 1.0) < 0.3) {  // a sliver
      const glm::vec3 offset(glm::dvec3(direction()) * spread * std::pow(10.0, uniform(-3.0, -1.0)));
      corners[2] = glm::mix(corners[0], corners[1], float(uniform(0.0, 1.0))) + offset;
    }
    return corners;
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  glm::dvec3 direction() {
    std::normal_distribution<double> normal;
    const glm::dvec3 d(normal(random_), normal(random_), normal(random_));
    return d / std::max(1e-9, glm::length(d));
  }
  std::mt19937_64 random_{20080215};
};

/// Weights of points all along the edges and some within.
inline const std::vector<glm::dvec3>& sample_weights() {
  static const std::vector<glm::dvec3> weights = [] {
    std::vector<glm::dvec3> list;
    constexpr int along = 24;
    for (int i = 0; i < along; ++i) {
      const double t = double(i) / along;
      for (const double s : {t, t * t * t}) {  // ends are where edges far from the centre have most of their image
        list.emplace_back(s, 1.0 - s, 0.0);
        list.emplace_back(0.0, s, 1.0 - s);
        list.emplace_back(1.0 - s, 0.0, s);
      }
      list.emplace_back(0.5 * t, 0.5 - 0.5 * t, 0.5);
      list.emplace_back(0.01, t * 0.99, 0.99 - t * 0.99);
    }
    return list;
  }();
  return weights;
}

/// Points of the triangle's image that are seen: all along its edges and within.
inline std::vector<glm::dvec2> seen_points(const Lens& lens, const std::array<glm::vec3, 3>& corners) {
  std::vector<glm::dvec2> points;
  const glm::dvec2 size(lens.size.width, lens.size.height);
  for (const glm::dvec3& weight : sample_weights()) {
    const auto pixel = lens.project(weight.x * glm::dvec3(corners[0]) + weight.y * glm::dvec3(corners[1]) +
                                    weight.z * glm::dvec3(corners[2]));
    if (pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= size.x && pixel->y <= size.y) {
      points.push_back(*pixel);
    }
  }
  return points;
}

/// For a failure's message.
inline std::string triangle_text(const std::array<glm::vec3, 3>& corners) {
  std::string text;
  for (const glm::vec3& c : corners) text += fmt::format(" ({:.9g}, {:.9g}, {:.9g})", c.x, c.y, c.z);
  return text;
}

inline bool is_enclosed(const glm::dvec2& pixel, const std::vector<BoundingPart>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const BoundingPart& part) { return part.contains(pixel); });
}

}  // namespace omma
