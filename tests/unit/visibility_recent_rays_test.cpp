// Rays are kept for a camera that stands still, in bounded memory, and are the same ones.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstring>

#include "omma/camera/sampling_pattern.h"
#include "omma/visibility/recent_rays.h"

namespace omma {
namespace {

bool is_kept(const std::shared_ptr<const RaySource>& rays) {
  return dynamic_cast<const RayTree*>(rays.get()) != nullptr;
}

TEST(RecentRaysTest, OfACameraThatStandsStillAreKept) {
  const std::vector<glm::dvec2> one = sampling_pattern(1), four = sampling_pattern(4);
  const Camera still = make_camera("equidistant:fov_deg=200", ImageSize{120, 90});
  RecentRays recent;
  EXPECT_FALSE(is_kept(recent.of(still, four)));
  EXPECT_FALSE(is_kept(recent.of(still, one)));
  for (int fov_deg = 100; fov_deg < 103; ++fov_deg) {
    const Camera other = make_camera(fmt::format("equidistant:fov_deg={}", fov_deg), ImageSize{120, 90});
    EXPECT_FALSE(is_kept(recent.of(other, four)));
  }
  const std::shared_ptr<const RaySource> kept = recent.of(still, four);
  ASSERT_TRUE(is_kept(kept));
  const RayTree made(CameraRays(still, {0, 0, 120, 90}, four));
  RayRoom room;
  const RaySquares squares = kept->some(0, kept->squares(), room);
  ASSERT_EQ(squares.blocks.size(), made.blocks().size());
  for (size_t i = 0; i < made.blocks().size(); ++i) {
    EXPECT_EQ(squares.blocks[i].pixel_x, made.blocks()[i].pixel_x);
    EXPECT_EQ(squares.blocks[i].leaf_mask, made.blocks()[i].leaf_mask);
    EXPECT_EQ(std::memcmp(squares.blocks[i].x, made.blocks()[i].x, sizeof made.blocks()[i].x), 0);
  }
}

TEST(RecentRaysTest, TakeNoMoreMemoryThanTheyMay) {
  const std::vector<glm::dvec2> four = sampling_pattern(4);
  RecentRays recent;
  size_t patches = 0;
  for (int fov_deg = 100; fov_deg < 103; ++fov_deg) {
    const Camera camera = make_camera(fmt::format("equirectangular:yaw_deg={}", fov_deg), ImageSize{1600, 1000});
    const size_t before = recent.bytes();
    recent.of(camera, four);
    patches += recent.bytes() - before;
    EXPECT_TRUE(is_kept(recent.of(camera, four)));
    EXPECT_LE(recent.bytes(), RecentRays::most_bytes + patches);
  }
  // One sample, just below the limit, the rays around squares included.
  const Camera just = make_camera("equirectangular", ImageSize{4000, 3900});
  RecentRays single;
  single.of(just, {glm::dvec2(0.0)});
  const size_t of_patches = single.bytes();
  EXPECT_TRUE(is_kept(single.of(just, {glm::dvec2(0.0)})));
  EXPECT_LE(single.bytes(), RecentRays::most_bytes + of_patches);
  const Camera large = make_camera("equirectangular", ImageSize{3200, 1600});
  recent.of(large, four);
  EXPECT_FALSE(is_kept(recent.of(large, four)));
}

}  // namespace
}  // namespace omma
