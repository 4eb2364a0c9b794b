// Bounding shapes enclose what they say they enclose: random triangles, their images sampled densely.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>

#include "omma/camera/bounds/lens_bound.h"
#include "tests/unit/camera_directions.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

/// OMMA_FULL_PROOF=1 asks for ten million triangles.
size_t triangles_of_each_camera(size_t cameras) {
  const char* full = std::getenv("OMMA_FULL_PROOF");
  return full != nullptr && std::string_view(full) == "1" ? 10'000'000 / cameras + 1 : 400;
}

constexpr double margin_px = 0.0625;

struct TestCamera {
  std::string text;
  Lens lens;
  LensBound bound;
};

/// Lenses whose lines bend away from the axis, everywhere or towards the border.
constexpr const char* bending_away[] = {
    "opencv:f=150,k1=0.2,width=321,height=240",
    "opencv:f=120,k1=-0.1,k2=0.1,width=321,height=240",
    "polynomial:f=40,k1=1,k3=0.4,k5=0.1,width=321,height=240",
    "polynomial:f=30,k1=0.5,k2=0.5,width=240,height=321",
    "polynomial:f=50,k1=1,k2=0.3,k3=0.2,width=321,height=240,yaw_deg=50",
};

/// Every sample camera whose lens the shapes are made for, and those.
const std::vector<TestCamera>& bounded_cameras() {
  static const std::vector<TestCamera> cameras = [] {
    std::vector<TestCamera> list;
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
const std::vector<glm::dvec3>& sample_weights() {
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

struct Tally {
  size_t triangles = 0, points = 0, outside = 0;
  std::map<std::string, size_t> paths;
  double shape_area = 0.0, image_area = 0.0;  ///< square pixels, of triangles that are wholly in the image
};

/// Square pixels of a triangle's image; nothing where the lens or the image does not show all of it.
std::optional<double> image_area(const Lens& lens, const std::array<glm::vec3, 3>& corners) {
  constexpr int along = 40;
  std::vector<glm::dvec2> outline;
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec3 from(corners[k]), to(corners[(k + 1) % 3]);
    for (int i = 0; i < along; ++i) {
      const auto pixel = lens.project(glm::mix(from, to, double(i) / along));
      if (!pixel || pixel->x < 0.0 || pixel->y < 0.0 || pixel->x > lens.size.width || pixel->y > lens.size.height) {
        return std::nullopt;
      }
      outline.push_back(*pixel);
    }
  }
  return BoundingPart{outline}.area();
}

std::string path_of(const std::vector<BoundingPart>& parts) {
  std::string path;
  for (const BoundingPart& part : parts) path += part.corners.size() == 3 ? "3" : "4";
  return path.empty() ? "none" : path;
}

void check(const TestCamera& camera, BoundingShape shape, const std::array<glm::vec3, 3>& corners, Tally& tally) {
  const std::vector<BoundingPart> parts = bounding_parts(camera.lens, camera.bound, shape, corners);
  ++tally.triangles;
  ++tally.paths[path_of(parts)];
  size_t triangles = 0;
  double area = 0.0;
  for (const BoundingPart& part : parts) {
    triangles += part.corners.size() - 2;
    area += part.area();
  }
  if (const auto image = image_area(camera.lens, corners); image && *image > 1.0) {
    tally.shape_area += area;
    tally.image_area += *image;
  }
  ASSERT_LE(triangles, shape == BoundingShape::triangles ? 4u : 2u);
  const glm::dvec2 size(camera.lens.size.width, camera.lens.size.height);
  for (const glm::dvec3& weight : sample_weights()) {
    const glm::dvec3 point =
        weight.x * glm::dvec3(corners[0]) + weight.y * glm::dvec3(corners[1]) + weight.z * glm::dvec3(corners[2]);
    const auto pixel = camera.lens.project(point);
    if (!pixel || glm::any(glm::lessThan(*pixel, glm::dvec2(0.0))) || glm::any(glm::greaterThan(*pixel, size)))
      continue;
    ++tally.points;
    if (std::any_of(parts.begin(), parts.end(), [&](const BoundingPart& part) { return part.contains(*pixel); })) {
      continue;
    }
    ++tally.outside;
    if (tally.outside <= 3) {
      std::string text;
      for (const glm::vec3& c : corners) text += fmt::format(" ({:.9g}, {:.9g}, {:.9g})", c.x, c.y, c.z);
      ADD_FAILURE() << camera.text << ": " << pixel->x << ", " << pixel->y << " of" << text << " is outside of its "
                    << path_of(parts);
    }
  }
}

TEST(BoundingShapes, EncloseEveryPointOfRandomTriangles) {
  const auto& cameras = bounded_cameras();
  ASSERT_GT(cameras.size(), 30u);
  const size_t count = triangles_of_each_camera(cameras.size());
  for (const BoundingShape shape : {BoundingShape::triangles, BoundingShape::quad}) {
    std::map<Lines, Tally> tallies;
    RandomTriangles random;
    for (const TestCamera& camera : cameras) {
      Tally& tally = tallies[camera.bound.lines];
      for (size_t i = 0; i < count; ++i) check(camera, shape, random.next(), tally);
    }
    for (const auto& [lines, tally] : tallies) {
      EXPECT_EQ(tally.outside, 0u);
      EXPECT_GT(tally.points, tally.triangles);
      std::string paths;
      for (const auto& [path, n] : tally.paths) {
        paths += fmt::format(" {} {:.1f}%", path, 100.0 * double(n) / double(tally.triangles));
      }
      std::cout << fmt::format("{}, lines {}: {} triangles, {} points, outside {}; overdraw {:.0f}%; polygons:{}\n",
                               shape == BoundingShape::quad ? "quad" : "triangle", lines_name(lines), tally.triangles,
                               tally.points, tally.outside, 100.0 * (tally.shape_area / tally.image_area - 1.0), paths);
    }
  }
}

}  // namespace
}  // namespace omma
