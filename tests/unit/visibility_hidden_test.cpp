// An object that the finder is told to leave out, against scenes without it.
#include <gtest/gtest.h>

#include "omma/camera/ray_bundle.h"
#include "omma/math/pose.h"
#include "omma/visibility/finder.h"
#include "tests/gpu/random_scenes.h"

namespace omma {
namespace {

/// Triangles keep their numbers.
Scene without(const Scene& scene, int object) {
  Scene rest = scene;
  std::erase_if(rest.instances, [&](const Instance& instance) { return instance.object == object; });
  return rest;
}

struct Found {
  std::vector<uint32_t> triangles;
  std::vector<float> distances;
  std::vector<std::vector<RayHit>> blended;
};

Found find(const Finder& finder, const RayTree& rays) {
  Found found;
  const size_t count = size_t(rays.size().width) * size_t(rays.size().height);
  std::vector<glm::uvec2> triangles(count);
  found.distances.resize(count);
  finder.nearest(rays, Solid::opaque, triangles, found.distances);
  for (const glm::uvec2& triangle : triangles) found.triangles.push_back(triangle.x);
  found.blended = finder.blended(rays, found.distances);
  return found;
}

/// How many rays see something else when `object` is gone.
size_t expect_hidden(const Scene& scene, const glm::dmat4& pose, int object) {
  const RayTree rays(rays_of(make_camera("equirectangular", ImageSize{96, 48})));
  const Scene rest = without(scene, object);
  const SceneIndex index(scene), index_of_rest(rest);
  // They stand beside each other over one index.
  const Finder with(index, pose), finder(index, pose, object), expected(index_of_rest, pose);
  const Found whole = find(with, rays), hidden = find(finder, rays), truth = find(expected, rays);
  EXPECT_EQ(hidden.triangles, truth.triangles) << object;
  EXPECT_EQ(hidden.distances, truth.distances) << object;
  size_t changed = 0;
  for (size_t i = 0; i < truth.triangles.size(); ++i) {
    EXPECT_EQ(hidden.blended[i].size(), truth.blended[i].size()) << object;
    changed += whole.triangles[i] != hidden.triangles[i] || whole.blended[i].size() != hidden.blended[i].size();
  }
  EXPECT_EQ(find(with, rays).triangles, whole.triangles);
  return changed;
}

TEST(HiddenObjectTest, IsSeenThrough) {
  size_t changed = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    Scene scene = random_soup(150, seed);
    if (seed % 2 == 1) {
      for (Material& material : scene.materials) material.alpha = Material::Alpha::blend;
    }
    const glm::dmat4 pose = pose_at({0.2, 0.1, -0.3}, 0.3, 0.1);
    for (const Instance& instance : scene.instances) changed += expect_hidden(scene, pose, instance.object);
  }
  EXPECT_GT(changed, 1000u);
}

TEST(HiddenObjectTest, IsLeftOutOfTheBodyThatItSharesWithOthers) {
  const Scene room = load_scene("room");
  const glm::dmat4 pose = look_at_worldFromCamera(room.default_from, room.default_to);
  size_t changed = 0;
  for (const Instance& instance : room.instances) changed += expect_hidden(room, pose, instance.object);
  EXPECT_GT(changed, 1000u);
  EXPECT_EQ(expect_hidden(room, pose, 12345), 0u);
}

}  // namespace
}  // namespace omma
