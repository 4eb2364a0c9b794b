// The tree over a camera's rays: nothing lost, every cone around its rays.
#include <gtest/gtest.h>

#include "omma/camera/ray_bundle.h"
#include "omma/visibility/cone_levels.h"
#include "omma/visibility/ray_tree.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

glm::vec3 ray_of(const RayBlock& block, int leaf, int ray) {
  return {block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]};
}

bool encloses(const Cone& cone, const glm::dvec3& direction) {
  if (cone.axis == glm::vec3(0.0f)) return cone.sin == 1.0f && cone.cos == 0.0f;
  const double angle =
      std::atan2(glm::length(glm::cross(glm::dvec3(cone.axis), direction)), glm::dot(glm::dvec3(cone.axis), direction));
  return angle < std::atan2(double(cone.sin), double(cone.cos));
}

bool near_its_pixel(const PixelGrid& grid, int column, int row, const glm::dvec3& direction) {
  if (!std::isfinite(grid.column_error) || !std::isfinite(grid.row_error)) return true;
  const double ahead = glm::dot(glm::dvec3(grid.axis), direction);
  return ahead > 0.0 &&
         std::abs(glm::dot(glm::dvec3(grid.column), direction) / ahead - column) <= double(grid.column_error) &&
         std::abs(glm::dot(glm::dvec3(grid.row), direction) / ahead - row) <= double(grid.row_error);
}

/// Every ray of the map is in the tree once, within its cones. Returns how many there are.
size_t check(const RayMap& rays) {
  const RayTree tree(rays);
  const ConeLevels above(tree);
  EXPECT_EQ(tree.size(), rays.size);
  EXPECT_LE(above.levels.back().count, ConeLevels::most_at_top);
  std::vector<int> met(rays.directions.size());
  size_t count = 0, outside = 0, wrong = 0;
  for (size_t b = 0; b < tree.blocks().size(); ++b) {
    const RayBlock& block = tree.blocks()[b];
    EXPECT_NE(block.leaf_mask, 0u);
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      for (int ray = 0; ray < 16; ++ray) {
        const glm::vec3 d = ray_of(block, leaf, ray);
        if (d == glm::vec3(0.0f)) continue;
        const int x = block.pixel_x + RayBlock::x_of(leaf, ray), y = block.pixel_y + RayBlock::y_of(leaf, ray);
        if (x >= rays.size.width || y >= rays.size.height || !(block.leaf_mask >> leaf & 1)) {
          ++wrong;
          continue;
        }
        const size_t pixel = size_t(y) * size_t(rays.size.width) + size_t(x);
        ++met[pixel];
        wrong += d != rays.directions[pixel];
        outside += !encloses(block.leaf_cone(leaf), d) || !encloses(block.cone, d);
        outside += !near_its_pixel(block.grid, x - block.pixel_x, y - block.pixel_y, d);
        size_t node = b * RayBlock::leaves + size_t(leaf);
        for (const ConeLevels::Level& level : above.levels) {
          outside += node >= level.count || !encloses(above.cones[level.first + node], d);
          node /= 16;
        }
        ++count;
      }
    }
  }
  for (size_t i = 0; i < met.size(); ++i) wrong += met[i] != (rays.directions[i] != glm::vec3(0.0f));
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(outside, 0u);
  return count;
}

TEST(RayTreeTest, ConesEncloseTheirRaysForEveryLens) {
  for (const LensModel& model : lens_models()) {
    for (const auto& [text, camera] : sample_cameras(model)) {
      SCOPED_TRACE(text);
      // A part of the image whose sides are no multiples of anything.
      const PixelRect part{camera.size().width / 3, camera.size().height / 3, camera.size().width - 37,
                           camera.size().height - 30};
      EXPECT_GT(check(rays_of(camera, part)), 500u);
    }
  }
}

TEST(RayTreeTest, PixelsLieOnAGridWhereTheLensBendsLittle) {
  const auto largest_error = [](const char* camera) {
    const RayTree tree(rays_of(make_camera(camera, ImageSize{800, 600})));
    float largest = 0.0f;
    for (const RayBlock& block : tree.blocks()) {
      const bool full =
          std::all_of(std::begin(block.rays), std::end(block.rays), [](uint16_t r) { return r == 0xffff; });
      if (full) largest = std::max({largest, block.grid.column_error, block.grid.row_error});
    }
    return largest;
  };
  // Observed: 0.084 and 0.184.
  EXPECT_LT(largest_error("perspective:fov_deg=90"), 0.1f);
  EXPECT_LT(largest_error("equidistant:fov_deg=180"), 0.2f);
}

TEST(RayTreeTest, HoldsRaysThatNoLensMakes) {
  RayMap rays{{37, 21}, {}, ""};
  for (int i = 0; i < 37 * 21; ++i) {
    const double angle = 2.399963 * i;  // all around, neighbours far from each other
    const double z = 1.0 - 2.0 * (i + 0.5) / (37 * 21);
    const double r = std::sqrt(1.0 - z * z);
    rays.directions.emplace_back(i % 7 == 0 ? glm::vec3(0.0f) : glm::vec3(r * std::cos(angle), r * std::sin(angle), z));
  }
  EXPECT_EQ(check(rays), 37u * 21u * 6u / 7u);
}

TEST(RayTreeTest, SmallAndEmptyImages) {
  EXPECT_EQ(check(RayMap{{1, 1}, {{0, 0, -1}}, ""}), 1u);
  EXPECT_EQ(check(RayMap{{3, 1}, {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}}, ""}), 2u);
  EXPECT_EQ(check(RayMap{{2, 2}, std::vector<glm::vec3>(4, glm::vec3(0.0f)), ""}), 0u);
  EXPECT_TRUE(RayTree(RayMap{{0, 0}, {}, ""}).blocks().empty());
}

}  // namespace
}  // namespace omma
