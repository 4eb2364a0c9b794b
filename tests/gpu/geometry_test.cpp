// What techniques compute without a GPU: cube faces, windows, clip spaces, culling, names.
#include <gtest/gtest.h>

#include <random>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/render/prepared_scene.h"
#include "omma/technique/image_based/cube.h"
#include "omma/technique/mesh_pass.h"
#include "omma/technique/planar/planar.h"
#include "omma/technique/registry.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

TEST(CubeTest, FacesAreRotationsThatLookSixWays) {
  glm::dvec3 sum(0.0);
  for (const glm::dmat3& face : faceFromCamera) {
    const glm::dmat3 identity = face * glm::transpose(face);
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) EXPECT_EQ(identity[c][r], c == r ? 1.0 : 0.0);
    }
    // Right, down and ahead: right-handed, so nothing is seen in a mirror.
    EXPECT_EQ(glm::determinant(face), 1.0);
    const glm::dvec3 ahead = glm::transpose(face)[2];
    EXPECT_EQ(std::abs(ahead.x) + std::abs(ahead.y) + std::abs(ahead.z), 1.0);
    sum += ahead;
  }
  EXPECT_EQ(sum, glm::dvec3(0.0));
}

TEST(CubeTest, WindowsHoldEveryRayOfTheRegion) {
  for (const LensModel& model : lens_models()) {
    for (const auto& [text, camera] : sample_cameras(model)) {
      SCOPED_TRACE(text);
      const PixelRect region{camera.size().width / 4, camera.size().height / 3, camera.size().width / 2,
                             camera.size().height};
      const auto windows = seen_windows(camera, region);
      // Windows are sampled once a pixel; techniques add two texels around, and a texel is a pixel at the centre.
      const double pixels = 2.0 / camera.pixels_per_radian();
      size_t inside = 0;
      // Passes shift by less than half a pixel. At half a pixel the rays of a cube layout lie on the cube's very edges,
      // where they belong to faces that the layout shows elsewhere.
      for (const double shift : {-0.499, 0.0, 0.499}) {
        for (const glm::vec3& d : rays_of(camera, region, glm::dvec2(shift)).directions) {
          if (d == glm::vec3(0.0f)) continue;
          size_t face = 0;
          for (size_t f = 1; f < windows.size(); ++f) {
            if ((faceFromCamera[f] * glm::dvec3(d)).z > (faceFromCamera[face] * glm::dvec3(d)).z) face = f;
          }
          const glm::dvec3 p = faceFromCamera[face] * glm::dvec3(d);
          const glm::dvec2 tangent = glm::dvec2(p) / p.z;
          const bool found = glm::all(glm::lessThan(windows[face].min - pixels, tangent)) &&
                             glm::all(glm::lessThan(tangent, windows[face].max + pixels));
          inside += found;
          ASSERT_TRUE(found) << d.x << ", " << d.y << ", " << d.z;
        }
      }
      EXPECT_GT(inside, 100u);
    }
  }
}

TEST(FlatClipTest, TakesTheImagesEdgesToTheEdgesOfClipSpace) {
  const glm::dmat4 clip = clip_from_flat_frame({-0.3, 0.9}, {-0.2, 0.5});
  const auto at = [&](double x, double y, double z) {
    const glm::dvec4 p = clip * glm::dvec4(x * z, y * z, z, 1.0);
    return glm::dvec3(p) / p.w;
  };
  for (const double z : {0.5, 3.0, 1e5}) {
    EXPECT_NEAR(at(-0.3, -0.2, z).x, -1.0, 1e-12);
    EXPECT_NEAR(at(-0.3, -0.2, z).y, -1.0, 1e-12);
    EXPECT_NEAR(at(0.9, 0.5, z).x, 1.0, 1e-12);
    EXPECT_NEAR(at(0.9, 0.5, z).y, 1.0, 1e-12);
    EXPECT_NEAR(at(0.1, 0.1, z).z, double(near_depth) / z, 1e-15);  // larger is nearer
  }
}

TEST(FrustumTest, NeverLosesABoxWithAPointInside) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-5.0, 5.0), inside(-0.999, 0.999), size(0.0, 4.0);
  const glm::dmat4 clip = clip_from_flat_frame({-1.0, 0.4}, {-0.5, 0.8});
  size_t kept = 0, lost = 0;
  for (int i = 0; i < 20000; ++i) {
    Bounds box;
    box.add(glm::dvec3(any(random), any(random), any(random)));
    box.add(box.min + glm::dvec3(size(random), size(random), size(random)));
    const bool may = may_be_in_frustum(clip, box);
    (may ? kept : lost) += 1;
    const glm::dvec3 corner = box.center();
    const glm::dvec4 p = clip * glm::dvec4(corner, 1.0);
    const bool seen = p.w > 0.0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w;
    EXPECT_TRUE(may || !seen);
  }
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(lost, 1000u);
}

TEST(TechniqueListTest, NamesAreUniqueAndUnderstood) {
  const Camera flat = make_camera("perspective:fov_deg=90");
  for (const TechniqueInfo& technique : techniques()) {
    SCOPED_TRACE(technique.name);
    EXPECT_FALSE(technique.description.empty());
    EXPECT_EQ(std::count_if(techniques().begin(), techniques().end(),
                            [&](const TechniqueInfo& other) { return other.name == technique.name; }),
              1);
    EXPECT_NO_THROW(check_technique(technique.name));
    EXPECT_EQ(choose_technique(technique.name, flat).variant,
              technique.variants.empty() ? "" : technique.variants.front().name);
    for (const VariantInfo& variant : technique.variants) {
      const std::string text = technique.name + ":" + variant.name;
      EXPECT_EQ(choose_technique(text, flat).name(), text);
    }
    EXPECT_THROW(check_technique(technique.name + ":nonsense"), CommandError);
    EXPECT_THROW(check_technique(technique.name + "x"), CommandError);
  }
}

}  // namespace
}  // namespace omma
