// Pieces: the four variants draw the same picture, that of the camera made of the pieces; no sample belongs to two
// pieces or to none.
#include <fmt/core.h>

#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "omma/camera/pieces/approximate.h"
#include "omma/image/write.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"
#include "tests/proof.h"

namespace omma {
namespace {

/// The first is what others are compared with.
constexpr const char* variants[] = {"piecewise:compute", "piecewise:naive", "piecewise:feedback",
                                    "piecewise:tessellator"};

/// A view that bulges, as a camera texture of `texels` squares.
Camera deformed_camera(ImageSize texels, ImageSize size, double strength) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "omma_piecewise_test.npy";
  FloatImage offsets(texels, 2);
  for (int y = 0; y < texels.height; ++y) {
    for (int x = 0; x < texels.width; ++x) {
      const double u = (x + 0.5) / texels.width, v = (y + 0.5) / texels.height;
      const double fade = 16.0 * u * (1.0 - u) * v * (1.0 - v);
      offsets.at(x, y)[0] = float(strength * fade * std::sin(7.0 * v + 2.0 * u));
      offsets.at(x, y)[1] = float(strength * fade * std::sin(6.0 * u - v));
    }
  }
  write_image(path, offsets, Channel::uv);
  return make_camera(fmt::format("camera_texture:file={},base=perspective,fov_deg=100", path.string()), size);
}

/// One of each kind: strips, rows of quads, triangles, exact pieces, a camera in the pieces form.
std::vector<NamedCamera> kinds_of_cameras() {
  return {{"cylinder", make_camera("cylinder:fov_deg=360", ImageSize{200, 120})},
          {"equirectangular", make_camera("equirectangular", ImageSize{200, 100})},
          {"fisheye", make_camera("equidistant:fov_deg=220", ImageSize{150, 150})},
          {"cube", make_camera("cube_3x2", ImageSize{180, 120})},
          {"deformed", deformed_camera({16, 16}, {160, 120}, 0.06)},
          {"folded", deformed_camera({24, 24}, {160, 120}, 0.4)},
          {"ray map", wavy_ray_map(160)}};
}

glm::dmat4 turned(std::mt19937& random, const glm::dvec3& position) {
  std::normal_distribution<double> normal;
  glm::dmat4 pose =
      glm::mat4_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
  pose[3] = glm::dvec4(position, 1.0);
  return pose;
}

class PiecewiseTest : public GpuTest {
 protected:
  static IntImage ids(const Camera& camera, const glm::dmat4& pose, const std::string& technique,
                      const PieceOptions& pieces = {}) {
    return std::get<IntImage>(
        draw(camera, pose, {Channel::id}, {.technique = technique, .pieces = pieces}).at(Channel::id));
  }
};

TEST_F(PiecewiseTest, VariantsDrawTheSamePicture) {
  constexpr const char* scenes[] = {"city:blocks=1", "room", "terrain:triangles=1000"};
  const auto cameras = kinds_of_cameras();
  for (size_t column = 0; column < std::size(scenes); ++column) {
    const char* scene_name = scenes[column];
    const Scene scene = load_scene(scene_name);
    prepare(scene);
    for (size_t row = 0; row < cameras.size(); ++row) {
      if (!is_proved_today(row, column, std::size(scenes))) continue;
      const auto& [name, camera] = cameras[row];
      const IntImage first = ids(camera, default_pose(scene), variants[0]);
      const FloatImage color = draw_color(camera, default_pose(scene), {.technique = variants[0]});
      for (const char* variant : variants) {
        const double share = share_of_differences(ids(camera, default_pose(scene), variant), first);
        const double decibels = psnr(draw_color(camera, default_pose(scene), {.technique = variant}), color);
        // Mesa 22.3 places what comes from a geometry shader with another rounding: now and then a single sample.
        EXPECT_LE(share, 1e-4) << scene_name << ", " << name << ", " << variant;
        EXPECT_GT(decibels, 60.0) << scene_name << ", " << name << ", " << variant;
      }
    }
  }
}

TEST_F(PiecewiseTest, DrawsWhatRaysMeetThroughTheSamePieces) {
  const Scene scene = load_scene("facade:detail=0");
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  for (const auto& [name, camera] : kinds_of_cameras()) {
    const Camera pieces(approximate(camera).pieces);
    const Verdict verdict =
        judge(Oracle(scene, pose), pieces, ids(pieces, pose, variants[0]), {.radius = 1.0 / 128.0, .cracks = true});
    std::cout << fmt::format("{:16} {} pieces, {} pixels, {} at an edge, {} ties\n", name,
                             pieces.pieces()->pieces().size(), verdict.pixels, verdict.edges, verdict.ties);
    EXPECT_EQ(verdict.wrong, 0u) << name << ": " << verdict.first_wrong;
    EXPECT_LT(verdict.edges + verdict.ties, verdict.pixels / 200) << name;
    EXPECT_GT(verdict.hits, 1000u) << name;
  }
}

TEST_F(PiecewiseTest, RaycastTracesPieces) {
  const Scene scene = load_scene("facade:detail=0");
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  for (const auto& [name, camera] : kinds_of_cameras()) {
    const Camera pieces(approximate(camera).pieces);
    const double share = share_of_differences(ids(pieces, pose, variants[0]), ids(pieces, pose, "raycast"));
    const double decibels = psnr(draw_color(pieces, pose, {.technique = variants[0], .samples = 1}),
                                 draw_color(pieces, pose, {.technique = "raycast", .samples = 1}));
    std::cout << fmt::format("{:16} ids differ {:.4f}%, PSNR {:.1f} dB\n", name, 100 * share, decibels);
    EXPECT_LT(share, 2e-3) << name;
    EXPECT_GT(decibels, 30.0) << name;
  }
}

TEST_F(PiecewiseTest, StaysWithinTheToleranceOfTheLens) {
  const Scene scene = load_scene("facade:detail=0");
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  for (const char* text : {"cylinder:fov_deg=360", "equidistant:fov_deg=180", "stereographic:fov_deg=200", "panini"}) {
    const Camera camera = make_camera(text, ImageSize{160, 120});
    for (const double tolerance : {0.1, 0.5}) {
      const Verdict verdict =
          judge(Oracle(scene, pose), camera, ids(camera, pose, variants[0], {.tolerance_px = tolerance}),
                {.radius = tolerance + 1.0 / 128.0, .cracks = true});
      EXPECT_EQ(verdict.wrong, 0u) << text << ", " << tolerance << " px: " << verdict.first_wrong;
    }
  }
}

/// A closed box of half-transparent walls: every sample must be covered once, neither twice nor not at all.
Scene make_veil() {
  SceneMaker maker;
  Material veil = unlit({1, 1, 1, 0.5f});
  veil.alpha = Material::Alpha::blend;
  const int material = maker.add(veil);
  const glm::vec3 c[8] = {{-3, -2, -4}, {3, -2, -4}, {3, 2, -4}, {-3, 2, -4},
                          {-3, -2, 4},  {3, -2, 4},  {3, 2, 4},  {-3, 2, 4}};
  // Corner by corner so that faces look inwards.
  for (const auto& face : {glm::ivec4(0, 1, 2, 3), glm::ivec4(5, 4, 7, 6), glm::ivec4(4, 0, 3, 7),
                           glm::ivec4(1, 5, 6, 2), glm::ivec4(3, 2, 6, 7), glm::ivec4(4, 5, 1, 0)}) {
    maker.place(maker.add(make_quad(c[face.x], c[face.y], c[face.z], c[face.w], material)));
  }
  return maker.finish();
}

TEST_F(PiecewiseTest, CoversEverySampleOnce) {
  const Scene scene = make_veil();
  prepare(scene);
  std::mt19937 random(5);
  const int poses = full_proof() ? 1000 : 10;
  for (const auto& [name, camera] : kinds_of_cameras()) {
    size_t pixels = 0;
    for (int i = 0; i < poses; ++i) {
      const glm::dmat4 pose = turned(random, {0.3, -0.2, 1.1});
      const FloatImage picture =
          draw_color(camera, pose, {.technique = variants[size_t(i) % 4], .samples = 4, .background = glm::vec3(0.0f)});
      for (int y = 0; y < picture.size.height; ++y) {
        for (int x = 0; x < picture.size.width; ++x) {
          // Where a pixel has no ray, or only some of its samples have, there is less to see.
          bool inside = true;
          for (const glm::dvec2 beside : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}, {0.5, 0.5}}) {
            inside &= camera.unproject(glm::dvec2(x, y) + beside).has_value();
          }
          if (!inside) continue;
          ++pixels;
          // A sample more or less would be an eighth.
          ASSERT_NEAR(*picture.at(x, y), 0.5f, 0.01f) << name << ", pixel " << x << ", " << y << ", pose " << i;
        }
      }
    }
    EXPECT_GT(pixels, size_t(poses) * 5000u) << name;
  }
}

/// Single triangles where projections are at their worst.
TEST_F(PiecewiseTest, TrianglesThatHoldThePoleTheAntipodeOrTheWholeView) {
  const glm::vec3 triangles[][3] = {
      {{-5, 3, 4}, {6, 3, 5}, {0, 3, -7}},                 // over the zenith
      {{-5, -2, -4}, {6, -2, -5}, {0, -2, 7}},             // under the nadir
      {{-9, -8, 2}, {0, 12, 2}, {9, -7, 2}},               // around the point behind
      {{900, -800, -1}, {0, 1200, -1}, {-900, -700, -1}},  // half the world
      {{-0.01f, -50, -0.02f}, {40, 3, -3}, {-30, 20, 9}},  // through the axis, close by
      {{-1, -1, 3}, {1, -1, 3}, {0.2f, 1, 3}},             // across the seam
  };
  const auto cameras = kinds_of_cameras();
  for (size_t column = 0; column < std::size(triangles); ++column) {
    const auto& triangle = triangles[column];
    SceneMaker maker;
    Material material = unlit({1, 0, 0, 1});
    material.double_sided = true;
    Mesh mesh;
    mesh.material = maker.add(material);
    mesh.positions.assign(triangle, triangle + 3);
    mesh.normals.assign(3, glm::vec3(0, 0, 1));
    mesh.triangles = {{0, 1, 2}};
    maker.place(maker.add(mesh));
    const Scene scene = maker.finish();
    prepare(scene);
    const glm::dmat4 pose(1.0);
    for (size_t row = 0; row < cameras.size(); ++row) {
      if (!is_proved_today(row, column, std::size(triangles))) continue;
      const auto& [name, camera] = cameras[row];
      const Camera pieces(approximate(camera).pieces);
      const IntImage first = ids(pieces, pose, variants[0]);
      const Verdict verdict = judge(Oracle(scene, pose), pieces, first, {.radius = 1.0 / 128.0, .cracks = true});
      EXPECT_EQ(verdict.wrong, 0u) << name << ": " << verdict.first_wrong;
      for (const char* variant : variants) {
        EXPECT_LE(share_of_differences(ids(pieces, pose, variant), first), 1e-4) << name << ", " << variant;
      }
    }
  }
}

TEST_F(PiecewiseTest, ListsThatMustGrowAThousandfoldAreCompleteAtOnce) {
  SceneMaker maker;
  maker.place(maker.add(make_pane(-2.0f, 50.0f, maker.add(unlit({1, 0, 0, 1})))));
  const Scene scene = maker.finish();
  prepare(scene);
  // More pieces than the tessellation unit has points, more than a list may grow by in a round.
  const PieceOptions many{.count = 9000};
  const Camera camera = make_camera("equidistant:fov_deg=180", ImageSize{320, 320});
  const glm::dmat4 away = glm::rotate(glm::dmat4(1.0), 3.14159, glm::dvec3(0, 1, 0)), towards(1.0);
  for (int turn = 0; turn < 2; ++turn) {
    for (const glm::dmat4& pose : {away, towards}) {
      const IntImage truth = ids(camera, pose, variants[0], many);
      for (const char* variant : {"piecewise:feedback", "piecewise:tessellator"}) {
        EXPECT_EQ(share_of_differences(ids(camera, pose, variant, many), truth), 0.0) << variant << ", turn " << turn;
      }
    }
  }
  EXPECT_GE(*ids(camera, towards, "piecewise:feedback", many).at(160, 160), 0);
}

TEST_F(PiecewiseTest, FollowsASceneThatChangesEveryFrame) {
  Scene scene = make_ball_and_pane();
  prepare(scene);
  const Camera camera = make_camera("cylinder:fov_deg=360", ImageSize{200, 120});
  std::mt19937 random(3);
  for (int frame = 0; frame < 6; ++frame) {
    move_ball(scene, frame, random);
    follow(scene);
    const IntImage truth = ids(camera, glm::dmat4(1.0), "raycast");
    for (const char* variant : variants) {
      EXPECT_LT(share_of_differences(ids(camera, glm::dmat4(1.0), variant), truth), 0.01) << variant << ", " << frame;
    }
  }
}

TEST_F(PiecewiseTest, ANewDeformationEveryFrame) {
  const Scene scene = load_scene("facade:detail=0");
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  for (int frame = 0; frame < 5; ++frame) {
    const Camera camera = deformed_camera({16, 16}, {160, 120}, 0.02 * frame);
    for (const char* variant : variants) {
      EXPECT_LT(share_of_differences(ids(camera, pose, variant), ids(camera, pose, "raycast")), 5e-3)
          << variant << ", " << frame;
    }
  }
}

TEST_F(PiecewiseTest, TilesFitTogether) {
  const Scene scene = load_scene("facade:detail=0");
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  for (const auto& [name, camera] : kinds_of_cameras()) {
    const auto whole = draw(camera, pose, {Channel::id}, {.technique = variants[0]});
    const auto tiled = draw(camera, pose, {Channel::id}, {.technique = variants[0], .tile = 37});
    // A tile has matrices of its own, which round otherwise.
    EXPECT_LT(
        share_of_differences(std::get<IntImage>(whole.at(Channel::id)), std::get<IntImage>(tiled.at(Channel::id))),
        1e-3)
        << name;
  }
}

TEST_F(PiecewiseTest, ReportsItsPieces) {
  const Scene scene = load_scene("facade:detail=0");
  prepare(scene);
  RenderStats stats;
  const Channel wanted[] = {Channel::id};
  prepared().render(make_camera("cylinder:fov_deg=360", ImageSize{1600, 120}), default_pose(scene), wanted,
                    {.technique = variants[0], .pieces = {.count = 160}}, &stats);
  EXPECT_EQ(stats.pieces, 160u);
  EXPECT_GT(stats.piece_error_px, 0.0);
  EXPECT_LT(stats.piece_error_px, 0.25);
}

}  // namespace
}  // namespace omma
