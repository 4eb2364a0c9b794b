// Non-linear rasterization of what is hard to bound: triangles around the camera, huge, tiny, without area.
#include <fmt/core.h>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"
#include "tests/proof.h"

namespace omma {
namespace {

Mesh make_triangles(const std::vector<glm::vec3>& corners, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = corners;
  mesh.normals.assign(corners.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  mesh.uvs.assign(corners.size(), glm::vec2(0.0f));
  for (uint32_t i = 0; i + 2 < corners.size(); i += 3) mesh.triangles.emplace_back(i, i + 1, i + 2);
  return mesh;
}

/// A tetrahedron around the camera, whose corners and edges lie at poles, behind, and across seams; triangles a
/// thousand metres long and a millimetre short, needles, and two without area.
Scene hard_scene() {
  SceneMaker maker;
  Material material = unlit(glm::vec4(0.2f, 0.4f, 0.6f, 1.0f));
  material.double_sided = true;
  const int m = maker.add(material);
  const glm::vec3 a(0, 9, 0), b(8, -3, 5), c(-8, -3, 5), d(0, -3, -9);
  maker.place(maker.add(make_triangles({a, b, c, a, c, d, a, d, b, b, d, c}, m)));
  maker.place(maker.add(make_triangles({{-1e3f, -2.5f, -1e3f},
                                        {1e3f, -2.5f, -1e3f},
                                        {0, -2.5f, 1e3f},  // a ground that ends nowhere
                                        {0.01f, 0.01f, -0.1f},
                                        {0.011f, 0.01f, -0.1f},
                                        {0.01f, 0.011f, -0.1f},  // a millimetre
                                        {-1, 0.5f, 2},
                                        {1, 0.501f, 2},
                                        {-1, 0.502f, 2},  // a needle across the seam behind
                                        {0, 1, -1},
                                        {0, 2, -2},
                                        {0, 1, -1},  // no area
                                        {1, 1, -1},
                                        {2, 2, -2},
                                        {3, 3, -3}},  // seen from within its plane
                                       m)));
  return maker.finish();
}

class NonlinearTest : public GpuTest {};

TEST_F(NonlinearTest, DrawsWhatIsHardToBound) {
  const Scene scene = hard_scene();
  prepare(scene);
  // Not along any axis.
  const glm::dmat4 pose = look_at_worldFromCamera(glm::dvec3(0.05, 0.02, 0.03), glm::dvec3(1.0, 0.3, -2.0));
  const Oracle oracle(scene, pose);
  size_t edges = 0, pixels = 0;
  const std::vector<NamedCamera> cameras = all_cameras(96);
  for (size_t row = 0; row < cameras.size(); ++row) {
    if (!is_proved_today(0, row, cameras.size())) continue;
    const auto& [name, camera] = cameras[row];
    const Verdict verdict =
        judge(oracle, camera, draw_ids(camera, pose, "nonlinear"), {.radius = 1.0 / 128.0, .cracks = false});
    EXPECT_EQ(verdict.wrong, 0u) << name << ": " << verdict.first_wrong;
    edges += verdict.edges;
    pixels += verdict.pixels;
  }
  std::cout << fmt::format("{} of {} pixels at an edge\n", edges, pixels);
  EXPECT_LT(edges, pixels / 1000);
}

TEST_F(NonlinearTest, CountsTheFragmentsThatItTouchesAndKeeps) {
  const Scene scene = hard_scene();
  prepare(scene);
  const glm::dmat4 pose = look_at_worldFromCamera(glm::dvec3(0.05, 0.02, 0.03), glm::dvec3(1.0, 0.3, -2.0));
  const Oracle oracle(scene, pose);
  for (const char* text : {"equidistant:fov_deg=180", "equirectangular", "cube_3x2"}) {
    const Camera camera = make_camera(text, ImageSize{96, 64});
    size_t met = 0;
    for (int y = 0; y < camera.size().height; ++y) {
      for (int x = 0; x < camera.size().width; ++x) {
        const auto ray = camera.unproject({x + 0.5, y + 0.5});
        for (uint32_t t = 0; ray && t < scene.triangle_count(); ++t) met += oracle.meet(t, ray->direction).has_value();
      }
    }
    const Channel wanted[] = {Channel::id};
    RenderStats stats;
    prepared().render(camera, pose, wanted, {.technique = "nonlinear", .count_fragments = true}, &stats);
    ASSERT_TRUE(stats.bound_fragments.has_value());
    std::cout << fmt::format("{}: {} touched, {} kept, {} met\n", text, stats.bound_fragments->touched,
                             stats.bound_fragments->kept, met);
    // Edges may round to either side.
    EXPECT_NEAR(double(stats.bound_fragments->kept), double(met), 0.002 * double(met) + 2.0);
    EXPECT_GE(stats.bound_fragments->touched, stats.bound_fragments->kept);
  }
}

TEST_F(NonlinearTest, ShowsOverdrawBehindWhatIsKept) {
  const Scene scene = hard_scene();
  prepare(scene);
  const glm::dmat4 pose = look_at_worldFromCamera(glm::dvec3(0.05, 0.02, 0.03), glm::dvec3(1.0, 0.3, -2.0));
  const Camera camera = make_camera("equidistant:fov_deg=180", ImageSize{96, 96});
  const IntImage ids = draw_ids(camera, pose, "nonlinear");
  const FloatImage shown = draw_color(camera, pose, {.technique = "nonlinear", .samples = 1, .show = {Show::overdraw}});
  size_t hits = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (*ids.at(x, y) < 0) continue;
      ++hits;
      EXPECT_EQ(shown.at(x, y)[2], 0.0f) << x << ", " << y;
      EXPECT_LE(shown.at(x, y)[0] + shown.at(x, y)[1], 1.01f);
    }
  }
  EXPECT_GT(hits, 5000u);
  EXPECT_THROW(draw_color(camera, pose, {.technique = "raycast", .show = {Show::overdraw}}), CommandError);
}

}  // namespace
}  // namespace omma
