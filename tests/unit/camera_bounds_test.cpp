// Bounding shapes enclose what they say they enclose: random triangles, their images sampled densely.
#include <fmt/core.h>

#include <iostream>
#include <map>

#include "tests/proof.h"
#include "tests/unit/bounding_shape_cases.h"

namespace omma {
namespace {

size_t triangles_of_each_camera(size_t cameras) { return full_proof() ? 10'000'000 / cameras + 1 : 400; }

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

void check(const BoundedCamera& camera, BoundingShape shape, const std::array<glm::vec3, 3>& corners, Tally& tally) {
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
  for (const glm::dvec2& pixel : seen_points(camera.lens, corners)) {
    ++tally.points;
    if (is_enclosed(pixel, parts)) continue;
    ++tally.outside;
    if (tally.outside <= 3) {
      ADD_FAILURE() << camera.text << ": " << pixel.x << ", " << pixel.y << " of" << triangle_text(corners)
                    << " is outside of its " << path_of(parts);
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
    for (const BoundedCamera& camera : cameras) {
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
