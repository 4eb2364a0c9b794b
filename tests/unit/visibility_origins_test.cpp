// Rays that begin beside the camera's centre, as those of omnidirectional stereo do, against brute force in double
// precision and against Embree.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/oracle/embree_scene.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/finder.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"
#include "tests/gpu/random_scenes.h"
#include "tests/proof.h"

namespace omma {
namespace {

constexpr float circles[] = {0.0f, 0.03f, 1.0f};  // metres

struct Rays {
  RayMap directions;
  std::vector<glm::vec3> origins;
};

/// The right eye's: each ray touches a level circle around the centre.
Rays on_circle(const Camera& camera, float radius) {
  Rays rays{rays_of(camera), {}};
  for (const glm::vec3& d : rays.directions.directions) {
    const glm::vec3 right = glm::cross(d, glm::vec3(0, 1, 0));
    rays.origins.push_back(glm::length(right) > 0.0f ? radius * glm::normalize(right) : glm::vec3(0.0f));
  }
  return rays;
}

/// Wherever they like, within a ball.
Rays in_ball(const Camera& camera, float radius, unsigned seed) {
  Rays rays{rays_of(camera), {}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-radius, radius);
  for (size_t i = 0; i < rays.directions.directions.size(); ++i) {
    rays.origins.emplace_back(uniform(random), uniform(random), uniform(random));
  }
  return rays;
}

struct Found {
  std::vector<glm::uvec2> triangles;
  std::vector<float> distances;
  friend bool operator==(const Found&, const Found&) = default;
};

Found find(const Finder& finder, const RayTree& rays) {
  Found found;
  found.triangles.resize(size_t(rays.size().width) * size_t(rays.size().height));
  found.distances.resize(found.triangles.size());
  finder.nearest(rays, Solid::opaque, found.triangles, found.distances);
  return found;
}

struct Errors {
  size_t rays = 0, hits = 0, edges = 0, wrong = 0;
  double distance = 0.0;  ///< over the distance and a metre: vertices are metres away, and rounded as such
};

/// Moves the camera to where each ray begins: slow, but nothing is new there.
Errors compare(const Scene& scene, const glm::dmat4& pose, const Rays& rays, const Found& found) {
  constexpr double beside = 1e-5;  // radians, and relative of distances
  Errors errors;
  for (size_t i = 0; i < rays.origins.size(); ++i) {
    const glm::dvec3 direction(rays.directions.directions[i]);
    if (direction == glm::dvec3(0.0)) continue;
    const Oracle oracle(scene, pose * translation(glm::dvec3(rays.origins[i])));
    const auto hit = oracle.nearest(direction);
    const uint32_t id = found.triangles[i].x, expected = hit ? hit->triangle : meets_nothing;
    ++errors.rays;
    errors.hits += id != meets_nothing;
    if (id != expected) {
      const auto seen = id == meets_nothing ? std::nullopt : oracle.meet(id, direction);
      const bool tie = hit && seen && std::abs(seen->distance / hit->distance - 1.0) < beside;
      const bool edge = (id != meets_nothing && oracle.ends_within(id, direction, beside)) ||
                        (hit && oracle.ends_within(hit->triangle, direction, beside));
      // Triangles are tens of metres large: single precision cannot tell on which side of one a ray begins, so near.
      const bool begins = hit && hit->distance * oracle.cosine(*hit, direction) < 3e-5;
      ++(tie || edge || begins ? errors.edges : errors.wrong);
    } else if (hit) {
      // What moves a vertex across the ray moves the point on the ray by that over the cosine.
      const double reach = (hit->distance + 1.0) / std::max(0.02, oracle.cosine(*hit, direction));
      errors.distance = std::max(errors.distance, std::abs(found.distances[i] - hit->distance) / reach);
    }
  }
  return errors;
}

TEST(OriginsTest, AgreesWithBruteForceInManyRandomScenes) {
  const Camera panorama = make_camera("equirectangular", ImageSize{36, 18});
  const Camera fisheye = make_camera("equidistant:fov_deg=220", ImageSize{24, 24});
  Errors total;
  for (int i = 0; i < (full_proof() ? 400 : 12); ++i) {
    std::mt19937 random(static_cast<unsigned>(i));
    std::normal_distribution<double> normal;
    // Triangles of all sizes around the camera: some pass through the circle.
    const Scene scene = random_soup(10 + i % 90, unsigned(i));
    const glm::dmat4 pose = pose_at({normal(random), normal(random), normal(random)}, normal(random), normal(random));
    const SceneIndex index(scene);
    const Finder finder(index, pose);
    for (const float radius : circles) {
      for (const Rays& rays : {on_circle(panorama, radius), on_circle(fisheye, radius),
                               in_ball(panorama, radius, static_cast<unsigned>(i))}) {
        const Errors errors = compare(scene, pose, rays, find(finder, RayTree(rays.directions, rays.origins)));
        EXPECT_EQ(errors.wrong, 0u) << "scene " << i << ", circle of " << radius;
        total.hits += errors.hits;
        total.edges += errors.edges;
        total.distance = std::max(total.distance, errors.distance);
      }
    }
  }
  std::cout << total.hits << " hits, " << total.edges << " at an edge, distance off by " << total.distance << "\n";
  EXPECT_GT(total.hits, 15000u);
  EXPECT_LT(total.edges, total.hits / 5000);
  EXPECT_LT(total.distance, 1e-5);
}

TEST(OriginsTest, AgreesWithEmbree) {
  const Camera camera = make_camera("equirectangular", ImageSize{512, 256});
  size_t hits = 0, different = 0, farther_off = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Scene scene = random_soup(3000, seed);
    const glm::dmat4 pose = pose_at({0.2, 0.1, -0.3}, 0.4, 0.1);
    const SceneIndex index(scene);
    const Finder finder(index, pose);
    EmbreeScene embree(scene);
    embree.set_view(pose);
    for (const float radius : circles) {
      const Rays rays = on_circle(camera, radius);
      const Found found = find(finder, RayTree(rays.directions, rays.origins));
      std::vector<RayHit> traced(found.triangles.size());
      embree.nearest(rays.origins, rays.directions.directions, camera.size().width, Solid::opaque, traced);
      for (size_t i = 0; i < traced.size(); ++i) {
        hits += traced[i].triangle != meets_nothing;
        if (traced[i].triangle != found.triangles[i].x) {
          ++different;
        } else if (traced[i].triangle != meets_nothing) {
          EXPECT_EQ(traced[i].instance, found.triangles[i].y);
          const double off = std::abs(double(found.distances[i]) - double(traced[i].distance));
          farther_off += off > 1e-4 * (double(traced[i].distance) + 1.0);
        }
      }
    }
  }
  std::cout << hits << " hits, " << different << " differ, " << farther_off << " by more than 1e-4\n";
  EXPECT_GT(hits, 1000000u);
  EXPECT_LT(different, hits / 10000);
  // Triangles that are seen edge-on.
  EXPECT_LT(farther_off, hits / 1000);
}

TEST(OriginsTest, ACircleOfNothingIsTheCentreToTheBit) {
  const Camera camera = make_camera("equidistant:fov_deg=300", ImageSize{150, 150});
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Scene scene = random_soup(900, seed);
    const SceneIndex index(scene);
    const Finder finder(index, glm::dmat4(1.0));
    const Rays rays = on_circle(camera, 0.0f);
    const RayTree at_centre(rays.directions), on_nothing(rays.directions, rays.origins);
    EXPECT_TRUE(at_centre.origins().empty());
    EXPECT_EQ(on_nothing.origins().size(), on_nothing.blocks().size());
    EXPECT_EQ(find(finder, at_centre), find(finder, on_nothing));
  }
}

TEST(OriginsTest, ClosedScenesHaveNeitherHolesNorDoubleHits) {
  const Camera camera = make_camera("equirectangular", ImageSize{512, 256});
  const std::vector<float> no_limit(512 * 256, std::numeric_limits<float>::infinity());
  Material glass;
  glass.alpha = Material::Alpha::blend;
  glass.double_sided = true;
  for (unsigned seed = 0; seed < (full_proof() ? 100u : 2u); ++seed) {
    const Scene opaque = dented_ball(seed, Material{}), blended = dented_ball(seed, glass);
    const SceneIndex index(opaque), layers_index(blended);
    const Finder finder(index, glm::dmat4(1.0)), layers(layers_index, glm::dmat4(1.0));
    // The ball's dents come as near as 0.4 metres, its faces a little nearer.
    for (const float radius : {0.03f, 0.25f}) {
      const Rays rays = on_circle(camera, radius);
      const RayTree tree(rays.directions, rays.origins);
      size_t holes = 0, even = 0;
      for (const glm::uvec2& hit : find(finder, tree).triangles) holes += hit.x == meets_nothing;
      // Out of a closed surface leads an odd number of crossings.
      for (const auto& along_ray : layers.blended(tree, no_limit)) even += along_ray.size() % 2 == 0;
      EXPECT_EQ(holes, 0u) << seed;
      EXPECT_EQ(even, 0u) << seed << ", " << radius;
    }
  }
}

TEST(OriginsTest, SimdTargetsAgree) {
  const Scene scene = random_soup(2000, 23);
  const SceneIndex index(scene);
  const Finder finder(index, glm::dmat4(1.0));
  for (const float radius : circles) {
    const Rays rays = on_circle(make_camera("equidistant:fov_deg=220", ImageSize{200, 150}), radius);
    const RayTree tree(rays.directions, rays.origins);
    const Found expected = find(finder, tree);
    for (const std::string& target : simd_targets()) {
      use_simd_target(target);
      const Found found = find(finder, tree);
      size_t different = 0;
      for (size_t i = 0; i < found.triangles.size(); ++i) different += found.triangles[i] != expected.triangles[i];
      EXPECT_LE(different, 3u) << target << ", circle of " << radius;
    }
    use_simd_target("");
  }
}

TEST(OriginsTest, FarFromTheCentreTheyAreFoundAsFromThere) {
  // All rays from one place are those of a camera that stands there.
  const Scene scene = random_soup(400, 3);
  const Camera camera = make_camera("equidistant:fov_deg=300", ImageSize{100, 100});
  const glm::vec3 place(64.0f, -32.0f, 128.0f);
  Rays rays = on_circle(camera, 0.0f);
  rays.origins.assign(rays.origins.size(), place);
  const SceneIndex here_index(scene), there_index(scene);
  const Finder here(here_index, glm::dmat4(1.0)), there(there_index, translation(glm::dvec3(place)));
  const Found from_here = find(here, RayTree(rays.directions, rays.origins));
  const Found from_there = find(there, RayTree(rays.directions));
  size_t different = 0, hits = 0;
  for (size_t i = 0; i < from_here.triangles.size(); ++i) {
    different += from_here.triangles[i] != from_there.triangles[i];
    hits += from_there.triangles[i].x != meets_nothing;
  }
  EXPECT_GT(hits, 10u);
  EXPECT_LE(different, hits / 100);
}

TEST(OriginsTest, BlocksEncloseWhereTheirRaysBegin) {
  for (const float radius : circles) {
    const Rays rays = in_ball(make_camera("equidistant:fov_deg=220", ImageSize{90, 70}), radius, 5);
    const RayTree tree(rays.directions, rays.origins);
    for (size_t b = 0; b < tree.blocks().size(); ++b) {
      const RayBlock& block = tree.blocks()[b];
      const BlockOrigins& origins = tree.origins()[b];
      for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
        for (int ray = 0; ray < 16; ++ray) {
          if (!(block.rays[leaf] >> ray & 1)) continue;
          const int x = block.pixel_x + RayBlock::x_of(leaf, ray), y = block.pixel_y + RayBlock::y_of(leaf, ray);
          const glm::dvec3 offset(origins.x[leaf][ray], origins.y[leaf][ray], origins.z[leaf][ray]);
          const glm::dvec3 origin(rays.origins[size_t(y) * 90 + size_t(x)]);
          EXPECT_LT(glm::distance(offset + glm::dvec3(origins.apex), origin), 2e-7 * radius + 1e-30);
          EXPECT_LE(glm::length(offset), double(origins.radius));
        }
      }
    }
  }
}

TEST(OriginsTest, RefusesOriginsThatAreNone) {
  const RayMap rays{{2, 1}, {{0, 0, -1}, {0, 0, 1}}, ""};
  const std::vector<glm::vec3> one(1), nowhere{{0, 0, 0}, {0, NAN, 0}}, far{{0, 0, 0}, {INFINITY, 0, 0}};
  EXPECT_THROW(RayTree(rays, one), CommandError);
  EXPECT_THROW(RayTree(rays, nowhere), CommandError);
  EXPECT_THROW(RayTree(rays, far), CommandError);
}

}  // namespace
}  // namespace omma
