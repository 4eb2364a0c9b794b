// The finder of compute shaders against the one on the processor and against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <set>

#include "omma/base/error.h"
#include "omma/camera/pieces/approximate.h"
#include "omma/camera/ray_bundle.h"
#include "omma/technique/visibility/gpu_finder.h"
#include "omma/visibility/finder.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"
#include "tests/gpu/random_scenes.h"
#include "tests/proof.h"

namespace omma {
namespace {

constexpr uint32_t none = meets_nothing;
constexpr float infinity = std::numeric_limits<float>::infinity();

class GpuFinderTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { context_ = std::make_unique<gl::Context>(); }
  static void TearDownTestSuite() { context_.reset(); }
  static const gl::Context& context() { return *context_; }

 private:
  static inline std::unique_ptr<gl::Context> context_;
};

/// Both finders over one scene, seen from one place.
struct Finders {
  Finders(const Scene& scene, const gl::Context& gl, uint32_t most_entries = 1 << 20)
      : gpu_scene(scene, gl),
        index(scene),
        tools{gl, gpu_scene, index, programs},
        gpu(tools, most_entries),
        context(gl) {
    set_view(glm::dmat4(1.0));
  }
  void set_view(const glm::dmat4& pose) {
    gpu.set_view(pose);
    cpu.emplace(index.get(), pose);
  }
  std::vector<glm::uvec2> by_cpu(const RayMap& rays, Solid solid = Solid::opaque) {
    std::vector<glm::uvec2> hits(rays.directions.size());
    cpu->nearest(RayTree(rays), solid, hits);
    return hits;
  }
  std::vector<glm::uvec2> by_gpu(const RayMap& rays, Solid solid = Solid::opaque) {
    return gpu.nearest(GpuRays(RayTree(rays), context.limits()), solid).hits;
  }
  std::vector<std::vector<RayHit>> layers_by_gpu(const RayMap& rays) {
    const GpuRays on_gpu(RayTree(rays), context.limits());
    gpu.nearest(on_gpu, Solid::opaque);
    return gpu.blended(on_gpu);
  }
  std::vector<std::vector<RayHit>> layers_by_cpu(const RayMap& rays) {
    std::vector<glm::uvec2> hits(rays.directions.size());
    std::vector<float> distances(hits.size());
    const RayTree tree(rays);
    cpu->nearest(tree, Solid::opaque, hits, distances);
    return cpu->blended(tree, distances);
  }

  GpuScene gpu_scene;
  LazySceneIndex index;
  ProgramCache programs;
  DrawTools tools;
  GpuFinder gpu;
  std::optional<Finder> cpu;
  const gl::Context& context;
};

size_t different(const std::vector<glm::uvec2>& a, const std::vector<glm::uvec2>& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

size_t hits_in(const std::vector<glm::uvec2>& picture) {
  return size_t(std::count_if(picture.begin(), picture.end(), [](const glm::uvec2& hit) { return hit.x != none; }));
}

IntImage ids_of(const std::vector<glm::uvec2>& hits, ImageSize size) {
  IntImage ids(size, 1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      *ids.at(x, y) = int32_t(hits[size_t(y) * size_t(size.width) + size_t(x)].x);
    }
  }
  return ids;
}

TEST_F(GpuFinderTest, AgreesWithBruteForceThroughEveryCamera) {
  const Scene scene = random_soup(200, 11);
  const glm::dmat4 pose = pose_at({0.3, -0.2, 0.1}, 0.4, 0.2);
  const Oracle oracle(scene, pose);
  Finders finders(scene, context());
  finders.set_view(pose);
  Verdict total;
  for (const auto& [name, camera] : all_cameras(full_proof() ? 200 : 40)) {
    SCOPED_TRACE(name);
    const RayMap rays = rays_of(camera);
    const std::vector<glm::uvec2> picture = finders.by_gpu(rays), expected = finders.by_cpu(rays);
    const IntImage agreed = ids_of(expected, camera.size());
    const Verdict verdict = judge(oracle, camera, ids_of(picture, camera.size()), {.radius = 1e-3}, &agreed);
    EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
    EXPECT_LE(different(picture, expected), 3u);
    total.hits += verdict.hits;
  }
  EXPECT_GT(total.hits, 20000u);
}

TEST_F(GpuFinderTest, SeesManyRandomScenesAsTheProcessorDoes) {
  const int scenes = full_proof() ? 1000 : 40;
  const Camera fisheye = make_camera("equidistant:fov_deg=300", ImageSize{40, 40});
  const Camera panorama = make_camera("equirectangular", ImageSize{64, 32});
  size_t hits = 0, differences = 0;
  for (int i = 0; i < scenes; ++i) {
    std::mt19937 random(static_cast<unsigned>(i));
    std::normal_distribution<double> normal;
    const Scene scene = random_soup(4 + 7 * i % 900, unsigned(i));
    const glm::dmat4 pose = pose_at({normal(random), normal(random), normal(random)}, normal(random), normal(random));
    const Oracle oracle(scene, pose);
    Finders finders(scene, context());
    finders.set_view(pose);
    for (const Camera& camera : {fisheye, panorama}) {
      const RayMap rays = rays_of(camera);
      const std::vector<glm::uvec2> picture = finders.by_gpu(rays), expected = finders.by_cpu(rays);
      const IntImage agreed = ids_of(expected, camera.size());
      const Verdict verdict = judge(oracle, camera, ids_of(picture, camera.size()), {.radius = 1e-3}, &agreed);
      EXPECT_EQ(verdict.wrong, 0u) << "scene " << i << ": " << verdict.first_wrong;
      hits += verdict.hits;
      differences += different(picture, expected);
    }
  }
  std::cout << differences << " of " << hits << " rays differ\n";
  EXPECT_GT(hits, size_t(scenes) * 500u);
  EXPECT_LT(differences, hits / 5000);
}

TEST_F(GpuFinderTest, NeitherHugeNorTinyScenesLoseAnything) {
  const RayMap rays = rays_of(make_camera("equirectangular", ImageSize{64, 32}));
  std::vector<glm::uvec2> expected;
  // Powers of two, so that all of them are the same scene to the bit.
  for (const int exponent : {0, -40, 30, 90, -100}) {
    const Scene scene = random_soup(200, 5, std::ldexp(1.0f, exponent));
    const std::vector<glm::uvec2> picture = Finders(scene, context()).by_gpu(rays);
    if (exponent == 0) expected = picture;
    EXPECT_TRUE(picture == expected) << "times 2 to the " << exponent;
  }
  EXPECT_GT(hits_in(expected), 1000u);
}

TEST_F(GpuFinderTest, LosesNothingAMillionMetresAway) {
  const RayMap rays = rays_of(make_camera("equidistant:fov_deg=300", ImageSize{48, 48}));
  Scene scene = random_soup(200, 9);
  const std::vector<glm::uvec2> expected = Finders(scene, context()).by_gpu(rays);
  const glm::dvec3 far(1048576.0, -2097152.0, 524288.0);
  for (Instance& instance : scene.instances) instance.worldFromObject[3] += glm::dvec4(far, 0.0);
  Finders there(scene, context());
  there.set_view(glm::translate(glm::dmat4(1.0), far));
  EXPECT_TRUE(there.by_gpu(rays) == expected);
}

TEST_F(GpuFinderTest, ClosedScenesHaveNeitherHolesNorDoubleHits) {
  const int balls = full_proof() ? 100 : 2;
  Material glass;
  glass.alpha = Material::Alpha::blend;
  const RayMap rays = rays_of(make_camera("equirectangular", ImageSize{512, 256}));
  for (int i = 0; i < balls; ++i) {
    for (const bool double_sided : {false, true}) {
      Material solid;
      solid.double_sided = glass.double_sided = double_sided;
      const Scene opaque = dented_ball(unsigned(i), solid), blended = dented_ball(unsigned(i), glass);
      EXPECT_EQ(hits_in(Finders(opaque, context()).by_gpu(rays)), rays.directions.size()) << i;
      size_t not_one = 0;
      for (const auto& along_ray : Finders(blended, context()).layers_by_gpu(rays)) not_one += along_ray.size() != 1;
      EXPECT_EQ(not_one, 0u) << i;
    }
  }
}

TEST_F(GpuFinderTest, ATieBelongsToTheLowerId) {
  // A grid twice, and rays through its corners, edges and diagonals.
  Material material;
  material.double_sided = true;
  Mesh mesh;
  constexpr int side = 9;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) mesh.positions.emplace_back(x - 4, y - 4, -8);
  }
  for (int copy = 0; copy < 2; ++copy) {
    for (uint32_t y = 0; y + 1 < side; ++y) {
      for (uint32_t x = 0; x + 1 < side; ++x) {
        const uint32_t corner = y * side + x;
        mesh.triangles.emplace_back(corner, corner + 1, corner + side + 1);
        mesh.triangles.emplace_back(corner, corner + side + 1, corner + side);
      }
    }
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  RayMap rays{{29, 29}, {}, ""};
  for (int y = -14; y <= 14; ++y) {
    for (int x = -14; x <= 14; ++x) {
      rays.directions.push_back(glm::normalize(glm::vec3(0.25f * float(x), 0.25f * float(y), -8.0f)));
    }
  }
  SceneMaker maker;
  mesh.material = maker.add(material);
  maker.place(maker.add(mesh), glm::dmat4(1.0));
  const Scene scene = maker.finish();
  Finders finders(scene, context());
  const std::vector<glm::uvec2> picture = finders.by_gpu(rays);
  for (const glm::uvec2& hit : picture) EXPECT_LT(hit.x, 2u * (side - 1) * (side - 1));
}

/// Panes with a texture's holes and with vertices that cover less and less, in every way of wrapping.
Scene make_panes(Material::Alpha alpha) {
  SceneMaker maker;
  std::mt19937 random(3);
  int number = 0;
  for (const Texture::Wrap u : {Texture::Wrap::repeat, Texture::Wrap::clamp, Texture::Wrap::mirror}) {
    for (const Texture::Wrap v : {Texture::Wrap::mirror, Texture::Wrap::repeat, Texture::Wrap::clamp}) {
      Texture texture;
      texture.width = 7;
      texture.height = 5;
      texture.wrap_u = u;
      texture.wrap_v = v;
      for (int i = 0; i < 35; ++i) texture.texels.emplace_back(200, 100, 50, uint8_t(random() & 255u));
      Material material;
      material.alpha = alpha;
      material.alpha_cutoff = 0.45f;
      material.double_sided = number % 2 == 0;
      material.base_color.a = 0.95f;
      material.base_color_texture = maker.add(texture);
      Mesh mesh = make_pane(-4.0f - float(number), 5.0f + float(number), maker.add(material));
      for (glm::vec2& uv : mesh.uvs) uv = 3.7f * uv - 1.3f;
      if (number % 3 == 0) mesh.colors = {glm::u8vec4(255), {255, 255, 255, 90}, glm::u8vec4(255), {9, 9, 9, 180}};
      maker.place(maker.add(mesh), glm::rotate(glm::dmat4(1.0), 0.1 * number + 0.03, glm::dvec3(0, 0, 1)));
      ++number;
    }
  }
  return maker.finish();
}

TEST_F(GpuFinderTest, SeesThroughHoles) {
  const RayMap rays = rays_of(make_camera("equidistant:fov_deg=150", ImageSize{160, 120}));
  const Scene masked = make_panes(Material::Alpha::mask), blended = make_panes(Material::Alpha::blend);
  Finders mask(masked, context());
  std::vector<glm::uvec2> picture = mask.by_gpu(rays);
  // Observed: none differ.
  EXPECT_LE(different(picture, mask.by_cpu(rays)), 5u);
  std::set<uint32_t> seen;
  for (const glm::uvec2& hit : picture) seen.insert(hit.y);
  EXPECT_GT(seen.size(), 5u);
  Finders blend(blended, context());
  picture = blend.by_gpu(rays, Solid::labels);
  EXPECT_LE(different(picture, blend.by_cpu(rays, Solid::labels)), 5u);
  EXPECT_EQ(hits_in(blend.by_gpu(rays)), 0u);
}

TEST_F(GpuFinderTest, FindsTheLayersThatTheProcessorFinds) {
  const RayMap rays = rays_of(make_camera("equidistant:fov_deg=150", ImageSize{160, 120}));
  const Scene scene = make_panes(Material::Alpha::blend);
  Finders finders(scene, context());
  const auto layers = finders.layers_by_gpu(rays), expected = finders.layers_by_cpu(rays);
  ASSERT_EQ(layers.size(), expected.size());
  size_t differences = 0, most = 0;
  for (size_t i = 0; i < layers.size(); ++i) {
    most = std::max(most, layers[i].size());
    const bool same = std::equal(layers[i].begin(), layers[i].end(), expected[i].begin(), expected[i].end(),
                                 [](const RayHit& a, const RayHit& b) {
                                   return a.triangle == b.triangle && a.instance == b.instance &&
                                          std::abs(a.distance / b.distance - 1.0f) < 1e-5f;
                                 });
    differences += !same;
  }
  EXPECT_GE(most, 5u);
  EXPECT_LE(differences, 3u);
}

TEST_F(GpuFinderTest, ListsThatAreTooShortLoseNothing) {
  const Scene scene = random_soup(3000, 21), glass = make_panes(Material::Alpha::blend);
  const RayMap rays = rays_of(make_camera("equidistant:fov_deg=220", ImageSize{160, 120}));
  const std::vector<glm::uvec2> expected = Finders(scene, context()).by_gpu(rays);
  const auto layers = Finders(glass, context()).layers_by_gpu(rays);
  for (const uint32_t entries : {20000u, 4000u}) {
    Finders short_lists(scene, context(), entries);
    for (int run = 0; run < 2; ++run) EXPECT_TRUE(short_lists.by_gpu(rays) == expected) << entries;
    const auto few = Finders(glass, context(), entries).layers_by_gpu(rays);
    for (size_t i = 0; i < layers.size(); ++i) ASSERT_EQ(few[i].size(), layers[i].size()) << "ray " << i;
  }
  EXPECT_THROW(Finders(scene, context(), 64).by_gpu(rays), MachineError);
}

TEST_F(GpuFinderTest, OneRunIsLikeTheNext) {
  const Scene scene = random_soup(2000, 23);
  const RayMap rays = rays_of(make_camera("equidistant:fov_deg=220", ImageSize{200, 150}));
  Finders finders(scene, context());
  const std::vector<glm::uvec2> expected = finders.by_gpu(rays);
  for (int run = 0; run < 4; ++run) EXPECT_TRUE(finders.by_gpu(rays) == expected);
  EXPECT_TRUE(Finders(scene, context()).by_gpu(rays) == expected);
}

TEST_F(GpuFinderTest, EmptyScenesAndSmallImages) {
  const Scene empty;
  Finders nothing(empty, context());
  for (const glm::uvec2& hit : nothing.by_gpu(rays_of(make_camera("equirectangular", ImageSize{33, 17})))) {
    EXPECT_EQ(hit, glm::uvec2(none));
  }
  const Scene scene = dented_ball(1, {});
  Finders finders(scene, context());
  EXPECT_NE(finders.by_gpu(RayMap{{1, 1}, {{0.6f, 0.0f, -0.8f}}, ""})[0].x, none);
  EXPECT_EQ(finders.by_gpu(RayMap{{1, 1}, {glm::vec3(0.0f)}, ""})[0], glm::uvec2(none, no_ray));
  EXPECT_TRUE(finders.by_gpu(RayMap{{0, 0}, {}, ""}).empty());
}

TEST_F(GpuFinderTest, DegenerateTrianglesAreNotSeen) {
  Material material;
  material.double_sided = true;
  SceneMaker maker;
  Mesh mesh;
  mesh.material = maker.add(material);
  // Below, wide enough to reach beyond the horizon on all sides but for its own height; one with a corner at the
  // centre; one whose plane goes through the centre; a line; a point; one that is not finite.
  mesh.positions = {{-1000, -1, -1000}, {1000, -1, -1000}, {0, -1, 2000}, {0, 0, 0},       {1, 5, 0},
                    {0, 5, 1},          {-3, 3, 0},        {3, 3, 0},     {0, -3, 0},      {1, 1, 1},
                    {2, 2, 2},          {3, 3, 3},         {NAN, 1, 1},   {1, INFINITY, 2}};
  mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {9, 9, 10}, {3, 3, 3}, {1, 2, 12}, {0, 1, 13}};
  maker.place(maker.add(mesh), glm::dmat4(1.0));
  const Scene scene = maker.finish();
  const auto picture = Finders(scene, context()).by_gpu(rays_of(make_camera("equirectangular", ImageSize{360, 180})));
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 360; ++x) {
      if (y <= 91 && y >= 89) continue;  // the horizon itself
      EXPECT_EQ(picture[size_t(y * 360 + x)].x, y > 91 ? 0u : none) << x << ", " << y;
    }
  }
}

TEST_F(GpuFinderTest, FollowsWhatMoves) {
  Scene scene = random_soup(600, 31);
  Finders moved(scene, context());
  for (Mesh& mesh : scene.meshes) {
    for (glm::vec3& p : mesh.positions) p = glm::vec3(1.3f * p.z, p.x + 0.5f * p.y, p.y - 1.0f);
  }
  scene.instances[0].worldFromObject = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 1.0, -2.0));
  SceneChanges changes{.moved = true};
  for (size_t m = 0; m < scene.meshes.size(); ++m) changes.deformed.insert(int(m));
  moved.index.update(changes);
  moved.gpu_scene.update(changes);
  moved.gpu.update();
  moved.set_view(glm::dmat4(1.0));
  const RayMap rays = rays_of(make_camera("equidistant:fov_deg=220", ImageSize{200, 150}));
  EXPECT_TRUE(moved.by_gpu(rays) == Finders(scene, context()).by_gpu(rays));
}

class GpuVisibilityTest : public GpuTest {};

TEST_F(GpuVisibilityTest, DrawsThePicturesOfTheProcessor) {
  std::vector<NamedCamera> cameras = all_cameras(96);
  // One of each form and one with jumps, those of pieces too.
  std::erase_if(cameras, [](const NamedCamera& c) {
    return c.name != "equidistant" && c.name != "cube_3x2" && c.name != "ray map" && c.name != "perspective";
  });
  ASSERT_EQ(cameras.size(), 4u);
  cameras.push_back({"pieces", Camera(approximate(make_camera("equidistant:fov_deg=120", ImageSize{96, 72})).pieces)});
  const Scene temple = load_scene("temple"), masked = make_panes(Material::Alpha::mask),
              blended = make_panes(Material::Alpha::blend);
  for (const Scene* scene : {&temple, &masked, &blended}) {
    const glm::dmat4 pose = scene == &temple ? default_pose(*scene) : glm::dmat4(1.0);
    prepare(*scene);
    for (const auto& [name, camera] : cameras) {
      SCOPED_TRACE(name);
      // A ray beside an edge may differ. Observed: none does.
      EXPECT_LT(
          share_of_differences(draw_ids(camera, pose, "visibility:gpu"), draw_ids(camera, pose, "visibility:cpu")),
          2e-3);
      EXPECT_GT(psnr(draw_color(camera, pose, {.technique = "visibility:gpu", .samples = 4}),
                     draw_color(camera, pose, {.technique = "visibility:resolve", .samples = 4})),
                50.0);
    }
  }
}

}  // namespace
}  // namespace omma
