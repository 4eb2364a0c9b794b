// Several samples of a pixel, found one by one and shaded once for each triangle, against as many pictures of one
// sample each. A scene with a blended material is drawn the latter way: hidden beneath the scene, one makes the
// difference.
#include <fmt/core.h>

#include <random>

#include "omma/camera/pieces/approximate.h"
#include "omma/technique/resolve.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/random_scenes.h"
#include "tests/proof.h"

namespace omma {
namespace {

constexpr const char* techniques_with_shifts[] = {"raycast", "visibility:resolve", "visibility:gpu"};
constexpr glm::vec3 backdrop(0.25f, 0.5f, 0.75f);

/// As it is, but drawn sample by sample.
Scene sample_by_sample(Scene scene) {
  const auto reach = scene.bounds();
  Material glass = unlit({1, 1, 1, 0.5f});
  glass.alpha = Material::Alpha::blend;
  scene.materials.push_back(glass);
  // Smaller than the gap between any two rays, behind everything.
  const glm::vec3 far_below(reach.min - 10.0 * (reach.max - reach.min));
  Mesh speck = make_quad(far_below, far_below + glm::vec3(1e-3f, 0, 0), far_below + glm::vec3(1e-3f, 0, 1e-3f),
                         far_below + glm::vec3(0, 0, 1e-3f), int(scene.materials.size()) - 1);
  scene.meshes.push_back(speck);
  Node node;
  node.matrix = glm::dmat4(1.0);
  scene.nodes.push_back(node);
  Instance instance;
  instance.mesh = int(scene.meshes.size()) - 1;
  instance.node = instance.object = int(scene.nodes.size()) - 1;
  scene.instances.push_back(instance);
  finish_scene(scene);
  return scene;
}

/// Triangles of all sizes, many of them smaller than a pixel, each of one colour; three materials.
Scene confetti() {
  Scene scene = random_soup(3000, 5);
  std::mt19937 random(6);
  std::uniform_int_distribution<int> part(0, 255);
  for (Material& material : scene.materials) material.unlit = true;
  for (Mesh& mesh : scene.meshes) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      mesh.colors.insert(mesh.colors.end(), 3, glm::u8vec4(part(random), part(random), part(random), 255));
    }
  }
  scene.materials.push_back(unlit({1, 0.5f, 0.25f, 1}));
  Mesh ball = make_ball(1.0f, int(scene.materials.size()) - 1);
  ball.colors.assign(ball.positions.size(), glm::u8vec4(255));
  for (glm::vec3& position : ball.positions) position += glm::vec3(1, 0.5, -3);
  scene.meshes.push_back(ball);
  Instance instance = scene.instances.front();
  instance.mesh = int(scene.meshes.size()) - 1;
  scene.instances.push_back(instance);
  finish_scene(scene);
  return scene;
}

std::vector<NamedCamera> cameras(ImageSize size) {
  std::vector<NamedCamera> all;
  for (const char* text : {"equidistant:fov_deg=180", "cylinder:fov_deg=360", "equirectangular", "cube_3x2"}) {
    all.push_back({text, make_camera(text, size)});
  }
  all.push_back({"ray map", wavy_ray_map(size.width)});
  all.push_back({"pieces", Camera(approximate(make_camera("cylinder:fov_deg=300", size)).pieces)});
  return all;
}

class SeveralSamplesTest : public GpuTest {
 protected:
  static FloatImage look(const Camera& camera, const glm::dmat4& pose, const RenderOptions& options,
                         RenderStats* stats = nullptr) {
    const Channel wanted[] = {Channel::color};
    return std::get<FloatImage>(prepared().render(camera, pose, wanted, options, stats).at(Channel::color));
  }
};

TEST_F(SeveralSamplesTest, WeighFlatColoursAsSoManyPicturesDo) {
  const Scene scene = confetti(), slow = sample_by_sample(scene);
  const glm::dmat4 pose = pose_at({0.3, -0.2, 0.1}, 0.4, 0.2);
  const std::vector<NamedCamera> views = cameras({96, 72});
  // The first of each view every day, so that each technique has several at once; the others by turns.
  const int counts[] = {4, 1, 2, 3, 7, 16, 20, 33};
  const auto is_counted = [&](size_t view, size_t count) {
    return count == 0 || is_proved_today(view, count, std::size(counts));
  };
  std::vector<FloatImage> truths;
  prepare(slow);
  for (size_t view = 0; view < views.size(); ++view) {
    const auto& [name, camera] = views[view];
    for (size_t count = 0; count < std::size(counts); ++count) {
      if (!is_counted(view, count)) continue;
      const int samples = counts[count];
      RenderStats stats;
      truths.push_back(
          look(camera, pose, {.technique = "raycast", .samples = samples, .background = backdrop}, &stats));
      EXPECT_EQ(stats.passes, samples);
    }
  }
  prepare(scene);
  double worst = 0.0;
  for (const std::string technique : techniques_with_shifts) {
    auto truth = truths.begin();
    for (size_t view = 0; view < views.size(); ++view) {
      const auto& [name, camera] = views[view];
      size_t other = 0;
      for (size_t count = 0; count < std::size(counts); ++count) {
        if (!is_counted(view, count)) continue;
        const int samples = counts[count];
        const FloatImage& expected = *truth++;
        if (technique == "visibility:gpu" && samples != 4 && samples != 20) continue;  // slow without a GPU
        SCOPED_TRACE(fmt::format("{} samples, {}, {}", samples, name, technique));
        RenderStats stats;
        const FloatImage found =
            look(camera, pose, {.technique = technique, .samples = samples, .background = backdrop}, &stats);
        EXPECT_EQ(stats.passes, (samples + 15) / 16);
        // Finders differ where a ray meets an edge, to rounding: a few pixels, by a sample each.
        size_t beyond = 0;
        for (int i = 0; i < found.size.width * found.size.height; ++i) {
          double largest = 0.0;
          for (int c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(double(found.values[size_t(3 * i + c)]) -
                                                 double(expected.values[size_t(3 * i + c)])));
          }
          if (largest > 1.0 / 512) {
            ++beyond;
            EXPECT_LE(largest, 2.5 / samples + 1.0 / 512);
          } else {
            worst = std::max(worst, largest);
          }
        }
        other += beyond;
        EXPECT_LE(beyond, technique == "raycast" ? 0u : 20u);
      }
      std::cout << fmt::format("{} {}: {} pixels by another sample\n", technique, name, other);
      EXPECT_LE(other, 20u);
    }
  }
  // Observed: 0.0007; half floats below one are 0.0005 apart, and a pixel is the sum of several.
  RecordProperty("largest_difference", fmt::format("{:.6f}", worst));
  std::cout << fmt::format("largest difference {:.6f}\n", worst);
  EXPECT_LT(worst, 1.0 / 512);
}

TEST_F(SeveralSamplesTest, ShadeRealScenesMuchAsSoManyPicturesDo) {
  for (const char* scene_name : {"city:blocks=2", "temple"}) {
    const Scene scene = load_scene(scene_name), slow = sample_by_sample(scene);
    const glm::dmat4 pose = default_pose(scene);
    const std::vector<NamedCamera> views = cameras({160, 120});
    const int counts[] = {1, 3, 4, 16, 20};
    std::vector<FloatImage> truths;
    prepare(slow);
    for (const auto& [name, camera] : views) {
      for (const int samples : counts) {
        truths.push_back(look(camera, pose, {.technique = "visibility:resolve", .samples = samples}));
      }
    }
    prepare(scene);
    auto truth = truths.begin();
    for (const auto& [name, camera] : views) {
      for (const int samples : counts) {
        const FloatImage found = look(camera, pose, {.technique = "visibility:resolve", .samples = samples});
        const double decibels = psnr(found, *truth++);
        std::cout << fmt::format("{} {} {}: {:.1f} dB\n", scene_name, name, samples, decibels);
        if (samples == 1) {
          EXPECT_EQ(decibels, std::numeric_limits<double>::infinity());
        } else {
          EXPECT_GT(decibels, 36.0);  // observed: 39.4
        }
      }
    }
  }
}

TEST_F(SeveralSamplesTest, ShadeATriangleOfAPixelOnce) {
  SceneMaker maker;
  maker.place(maker.add(make_pane(-2.0f, 1.0f, maker.add(unlit({1, 0, 0, 1})))));
  const Scene scene = maker.finish();
  prepare(scene);
  const Camera camera = make_camera("equidistant:fov_deg=120", ImageSize{64, 64});
  for (const std::string technique : techniques_with_shifts) {
    RenderStats stats;
    const FloatImage picture =
        look(camera, glm::dmat4(1.0), {.technique = technique, .samples = 16, .background = glm::vec3(0)}, &stats);
    // Two triangles: a pixel at their common edge may see both.
    size_t red = 0;
    for (int i = 0; i < 64 * 64; ++i) red += picture.values[size_t(3 * i)] > 0.0f;
    EXPECT_GE(stats.samples_kept, red) << technique;
    EXPECT_LE(stats.samples_kept, red + 64) << technique;
    EXPECT_GT(red, 500u) << technique;
  }
}

TEST_F(SeveralSamplesTest, GoWithShadowsEffectsAndReflections) {
  SceneMaker maker;
  Material floor;
  floor.double_sided = true;
  const int ball = maker.place(maker.add(make_ball(0.7f, maker.add(Material{}))), translation({0.5, -1.0, -2.0}));
  maker.place(maker.add(make_quad({-9, -2, 9}, {9, -2, 9}, {9, -2, -9}, {-9, -2, -9}, maker.add(floor))));
  Light sun;
  sun.color = glm::vec3(3.0f);
  maker.add(sun);
  const Scene scene = maker.finish(), slow = sample_by_sample(scene);
  const Camera camera = make_camera("equisolid:fov_deg=200", ImageSize{160, 120});
  std::vector<RenderOptions> pictures(3);
  pictures[0].shadows = Shadows::paraboloid;
  pictures[1].effects = {make_effect("hatching"), make_effect("wireframe")};
  pictures[2].reflect = ball;
  for (RenderOptions& options : pictures) {
    options.technique = "visibility:resolve";
    options.samples = 7;
    prepare(slow);
    const FloatImage expected = look(camera, glm::dmat4(1.0), options);
    prepare(scene);
    const double decibels = psnr(look(camera, glm::dmat4(1.0), options), expected);
    std::cout << fmt::format("{:.1f} dB\n", decibels);
    EXPECT_GT(decibels, 30.0);  // observed: 34.2, 32.7 (lines thinner than a pixel) and 56.4
  }
}

TEST_F(SeveralSamplesTest, FollowOneAnotherInAnySizeAndNumber) {
  // What a picture leaves behind is nothing to the next.
  const Scene scene = confetti();
  prepare(scene);
  const glm::dmat4 pose = pose_at({0.3, -0.2, 0.1}, 0.4, 0.2);
  const auto look_at = [&](ImageSize size, int samples) {
    return look(make_camera("equidistant:fov_deg=180", size), pose,
                {.technique = "visibility:resolve", .samples = samples});
  };
  const FloatImage first = look_at({60, 40}, 5);
  look_at({90, 70}, 16);
  look_at({31, 8}, 1);
  look_at({8, 31}, 3);
  EXPECT_EQ(largest_difference(look_at({60, 40}, 5), first), 0.0);
}

TEST(SamplesAtOnce, AreFewerInLargeTiles) {
  const gl::Context context;
  const Scene scene = SceneMaker().finish();
  const GpuScene gpu_scene(scene, context);
  ProgramCache programs;
  const LazySceneIndex index(scene);
  DrawTools tools{context, gpu_scene, index, programs};
  const Resolver resolver(tools);
  EXPECT_EQ(resolver.samples_at_once({1, 1}), 16u);
  EXPECT_EQ(resolver.samples_at_once({1600, 1200}), 16u);
  EXPECT_LE(resolver.samples_at_once({4096, 4096}), 2u);
  EXPECT_EQ(resolver.samples_at_once({16384, 16384}), 1u);
}

}  // namespace
}  // namespace omma
