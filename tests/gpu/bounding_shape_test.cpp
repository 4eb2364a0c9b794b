// Bounding shapes in GLSL, as technique nonlinear runs them, enclose what those in C++ are shown to enclose.
#include <fmt/core.h>

#include <iostream>

#include "omma/gl/context.h"
#include "omma/gl/shader_files.h"
#include "omma/math/pose.h"
#include "omma/technique/camera_program.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"
#include "tests/proof.h"
#include "tests/unit/bounding_shape_cases.h"

namespace omma {
namespace {

constexpr const char* body = R"glsl(
layout(local_size_x = 64) in;
uniform LensBound lens_bound;
layout(std430, binding = 0) readonly buffer Triangles { vec4 corners[]; };
struct Answer {
  vec4 corners[10];  // two a texel: of the quad, then of the parts
  ivec4 counts;      // of corners of each part
  ivec4 quad_count;
};
layout(std430, binding = 1) writeonly buffer Answers { Answer answers[]; };

vec3 optical(vec3 position) {
  vec3 in_lens = position * cameraFromLens;
  return vec3(in_lens.x, -in_lens.y, -in_lens.z);
}

void write(uint i, int at, BoundPart part) {
  for (int k = 0; k < 2; ++k) {
    answers[i].corners[at + k] = vec4(lens_centre + lens_focal * part.corner[2 * k],
                                      lens_centre + lens_focal * part.corner[2 * k + 1]);
  }
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(answers.length())) return;
  vec3 a = optical(corners[3u * i].xyz), b = optical(corners[3u * i + 1u].xyz), c = optical(corners[3u * i + 2u].xyz);
  BoundPart quad = bounding_quad(lens_params(), lens_bound, a, b, c);
  write(i, 0, quad);
  answers[i].quad_count = ivec4(quad.corners);
  BoundParts parts = bounding_triangles(lens_params(), lens_bound, a, b, c);
  ivec4 counts = ivec4(0);
  for (int k = 0; k < parts.count; ++k) {
    write(i, 2 + 2 * k, parts.part[k]);
    counts[k] = parts.part[k].corners;
  }
  answers[i].counts = counts;
}
)glsl";

struct Answer {
  glm::vec4 corners[10];
  glm::ivec4 counts, quad_count;

  BoundingPart part(int at, int count) const {
    BoundingPart part;
    for (int k = 0; k < count; ++k) {
      const glm::vec4 two = corners[at + k / 2];
      part.corners.emplace_back(k % 2 == 0 ? glm::vec2(two.x, two.y) : glm::vec2(two.z, two.w));
    }
    return part;
  }
  std::vector<BoundingPart> shape(BoundingShape kind) const {
    if (kind == BoundingShape::quad) return {part(0, quad_count.x)};
    std::vector<BoundingPart> parts;
    for (int k = 0; k < 4; ++k) {
      if (counts[k] > 0) parts.push_back(part(2 + 2 * k, counts[k]));
    }
    return parts;
  }
};

gl::Program link(const Camera& camera) {
  return link_compute(gl::assemble_shader("common/camera.glsl", camera_defines(camera)) +
                      std::string(gl::shader_files().at("bounds/bounding_shape.h")) + body);
}

TEST(BoundingShapesInGlsl, EncloseEveryPointOfRandomTriangles) {
  const gl::Context context;
  constexpr size_t count = 500;
  std::map<const LensModel*, gl::Program> programs;
  size_t points = 0, outside = 0, other_corners = 0, shapes = 0;
  RandomTriangles random;
  for (const BoundedCamera& bounded : bounded_cameras()) {
    // The calibrated ones' formulae are compared elsewhere, and their shapes are of the same kinds.
    if (bounded.lens.model->info.group != std::string("radial")) continue;
    const Camera camera(bounded.lens);
    std::vector<std::array<glm::vec3, 3>> triangles(count);
    std::vector<glm::vec4> corners;
    for (auto& triangle : triangles) {
      triangle = random.next();
      for (const glm::vec3& corner : triangle) corners.emplace_back(corner, 0.0f);
    }
    gl::Program& program = programs[bounded.lens.model];
    if (program.id() == 0) program = link(camera);
    set_camera(program, {.camera = camera, .worldFromCamera = glm::dmat4(1.0), .tile = {}});
    set_lens_bound(program, bounded.bound);
    const gl::Buffer in{std::span<const glm::vec4>(corners)};
    const gl::Buffer out(count * sizeof(Answer));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.id());
    program.use();
    glDispatchCompute(GLuint(count + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<Answer> answers(count);
    glGetNamedBufferSubData(out.id(), 0, GLsizeiptr(out.bytes()), answers.data());
    for (size_t i = 0; i < count; ++i) {
      for (const BoundingShape kind : {BoundingShape::triangles, BoundingShape::quad}) {
        const auto shape = answers[i].shape(kind);
        ++shapes;
        const auto in_cpp = bounding_parts(bounded.lens, bounded.bound, kind, triangles[i]);
        if (kind == BoundingShape::triangles) other_corners += in_cpp.size() != shape.size();
        for (const glm::dvec2& pixel : seen_points(bounded.lens, triangles[i])) {
          ++points;
          if (is_enclosed(pixel, shape)) continue;
          if (++outside <= 3) {
            ADD_FAILURE() << bounded.text << ": " << pixel.x << ", " << pixel.y << " of" << triangle_text(triangles[i])
                          << " is outside";
          }
        }
      }
    }
  }
  std::cout << fmt::format("{} shapes, {} points, {} outside; {} shapes have another number of parts than in C++\n",
                           shapes, points, outside, other_corners);
  EXPECT_EQ(outside, 0u);
  EXPECT_LT(other_corners, shapes / 100);
  EXPECT_GT(points, shapes * 20);
}

class BoundingShapesTest : public GpuTest {};

/// Walls all around of two triangles each, which reach behind the camera and enclose its poles, balls of small
/// triangles, and veils that may not be drawn twice.
Scene make_surroundings(bool veiled) {
  SceneMaker maker;
  Material material = unlit({0.2f, 0.5f, 0.8f, 1.0f});
  material.double_sided = true;
  const int paint = maker.add(material);
  const float r = 4.0f;
  const auto wall = [&](const glm::vec3& normal, const glm::vec3& u, const glm::vec3& v) {
    maker.place(maker.add(
        make_quad(r * (normal - u - v), r * (normal + u - v), r * (normal + u + v), r * (normal - u + v), paint)));
  };
  const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const float side : {-1.0f, 1.0f}) {
    wall(side * x, y, z);
    wall(side * y, z, x);
    wall(side * z, x, y);
  }
  const int ball = maker.add(make_ball(1.0f, paint));
  for (const glm::dvec3& at : {glm::dvec3(0.3, -0.2, -2.5), glm::dvec3(2.6, 0.4, 0.1), glm::dvec3(-0.5, 1.0, 2.7)}) {
    maker.place(ball, translation(at));
  }
  if (veiled) {
    material.base_color = {0.9f, 0.4f, 0.1f, 0.5f};
    material.alpha = Material::Alpha::blend;
    const int veil = maker.add(material);
    maker.place(maker.add(make_pane(-1.2f, 0.9f, veil)));
    maker.place(maker.add(make_ball(3.5f, veil)));
  }
  return maker.finish();
}

/// One camera of each kind that shapes tell apart, and two that have no shapes.
std::vector<NamedCamera> cameras_of_each_kind() {
  std::map<std::pair<Lines, bool>, NamedCamera> kinds;
  for (const BoundedCamera& bounded : bounded_cameras()) {
    if (bounded.lens.size.width > 321) continue;
    kinds.emplace(std::pair(bounded.bound.lines, bounded.bound.within_half),
                  NamedCamera{bounded.text, Camera(bounded.lens)});
  }
  std::vector<NamedCamera> cameras{{"panorama", make_camera("equirectangular", ImageSize{160, 80})},
                                   {"ray map", wavy_ray_map(96)}};
  for (const auto& [kind, camera] : kinds) cameras.push_back(camera);
  return cameras;
}

/// Fragments decide what is seen, so shapes that enclose their triangles are seen to be right, and to differ in not one
/// pixel; but at the border of what the camera sees, where a sample without a ray goes with its pixel's centre.
TEST_F(BoundingShapesTest, DrawWhatRaysMeet) {
  const Scene scene = make_surroundings(false), veiled = make_surroundings(true);
  const glm::dmat4 pose = look_at_worldFromCamera({0.1, 0.2, 0.3}, {0.0, 0.1, -3.0});
  const Oracle oracle(scene, pose);
  size_t compared = 0, edges = 0, ties = 0;
  double least_psnr = 1e9;
  const auto cameras = cameras_of_each_kind();
  for (size_t row = 0; row < cameras.size(); ++row) {
    if (!is_proved_today(row)) continue;
    const auto& [name, camera] = cameras[row];
    SCOPED_TRACE(name);
    prepare(scene);
    const IntImage ids = draw_ids(camera, pose, "nonlinear:triangle");
    EXPECT_EQ(ids.values, draw_ids(camera, pose, "nonlinear:quad").values);
    const Verdict verdict = judge(oracle, camera, ids, {.radius = 5e-3});
    EXPECT_EQ(verdict.wrong, 0u) << verdict.first_wrong;
    edges += verdict.edges;
    ties += verdict.ties;

    prepare(veiled);
    const FloatImage a = draw_color(camera, pose, {.technique = "nonlinear:triangle"});
    const FloatImage b = draw_color(camera, pose, {.technique = "nonlinear:quad"});
    size_t differences = 0;
    for (int y = 0; y < a.size.height; ++y) {
      for (int x = 0; x < a.size.width; ++x) {
        bool whole = true;
        for (int k = 0; k < 4; ++k) whole = whole && camera.unproject({x + k % 2, y + k / 2}).has_value();
        if (!whole) continue;
        ++compared;
        for (int c = 0; c < 3; ++c) differences += a.at(x, y)[c] != b.at(x, y)[c];
      }
    }
    EXPECT_EQ(differences, 0u);
    // What is blended is blended once in either.
    least_psnr = std::min(least_psnr, psnr(a, draw_color(camera, pose, {.technique = "nonlinear:hybrid"})));
  }
  std::cout << fmt::format("{} pixels, ids: {} at an edge, {} ties; colours {:.1f} dB from hybrid's\n", compared, edges,
                           ties, least_psnr);
  EXPECT_GT(compared, full_proof() ? 100'000u : 5'000u);
  EXPECT_GT(least_psnr, 40.0);
}

}  // namespace
}  // namespace omma
