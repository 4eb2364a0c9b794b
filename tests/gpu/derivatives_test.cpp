// How textures change from pixel to pixel of a triangle, as fragments compute it, against central differences in double
// precision.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "omma/gl/context.h"
#include "omma/technique/camera_program.h"
#include "omma/technique/gpu_scene.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr const char* body = R"glsl(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Pixels { vec2 pixels[]; };
layout(std430, binding = 1) writeonly buffer Changes { vec4 changes[]; };  // uv_dx, uv_dy

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(pixels.length())) return;
  Surface surface = surface_of(triangle_of(i, instance_of(0u)), i, camera_ray(pixels[i]));
  changes[i] = vec4(surface.uv_dx, surface.uv_dy);
}
)glsl";

struct Case {
  glm::dvec2 pixel;
  glm::dmat3 corners;
  glm::dmat3x2 uvs;

  glm::dvec2 uv_along(const glm::dvec3& ray) const {
    const glm::dvec3 weights = glm::inverse(corners) * ray;
    return uvs * weights / (weights.x + weights.y + weights.z);
  }
};

/// Along the ray's own central difference over a pixel; nothing where the camera has a jump or an end near by.
std::optional<glm::dvec2> change_of(const Case& tested, const Camera& camera, const glm::dvec2& axis) {
  const auto here = camera.unproject(tested.pixel), before = camera.unproject(tested.pixel - 0.5 * axis),
             after = camera.unproject(tested.pixel + 0.5 * axis);
  if (!here || !before || !after) return std::nullopt;
  const double first = glm::distance(here->direction, before->direction),
               second = glm::distance(after->direction, here->direction);
  if (first > 2.0 * second || second > 2.0 * first) return std::nullopt;
  const glm::dvec3 change = after->direction - before->direction;
  constexpr double step = 1e-4;
  return (tested.uv_along(here->direction + step * change) - tested.uv_along(here->direction - step * change)) /
         (2.0 * step);
}

/// Triangles of 0.2 to 20 degrees around pixels' rays, their corners at distances of their own.
std::vector<Case> random_cases(const Camera& camera, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) {
    const ImageSize size = camera.size();
    const glm::dvec2 pixel =
        glm::floor(glm::dvec2(size.width, size.height) * glm::dvec2(unit(random), unit(random))) + 0.5;
    const auto ray = camera.unproject(pixel);
    if (!ray) continue;
    const glm::dvec3 d = ray->direction;
    const glm::dvec3 u = glm::normalize(glm::cross(d, std::abs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 v = glm::cross(d, u);
    const double angle = 0.0035 * std::pow(100.0, unit(random)), distance = std::pow(100.0, unit(random));
    Case made;
    made.pixel = pixel;
    for (int c = 0; c < 3; ++c) {
      const double turn = 2.0944 * c + unit(random);
      const glm::dvec3 corner =
          distance * (1.0 + angle * unit(random)) * (d + angle * (std::cos(turn) * u + std::sin(turn) * v));
      made.corners[c] = glm::dvec3(glm::vec3(corner));
      made.uvs[c] = glm::dvec2(glm::vec2(unit(random), unit(random)));
    }
    cases.push_back(made);
  }
  return cases;
}

Scene scene_of(const std::vector<Case>& cases) {
  SceneMaker maker;
  Mesh mesh;
  mesh.material = maker.add(unlit(glm::vec4(1.0f)));
  for (const Case& made : cases) {
    for (int c = 0; c < 3; ++c) {
      mesh.positions.emplace_back(made.corners[c]);
      mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
      mesh.uvs.emplace_back(made.uvs[c]);
    }
    const auto first = uint32_t(mesh.positions.size() - 3);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  maker.place(maker.add(std::move(mesh)));
  return maker.finish();
}

std::vector<glm::vec4> changes_of(const std::vector<Case>& cases, const Camera& camera, const gl::Context& context) {
  const Scene scene = scene_of(cases);
  GpuScene on_gpu(scene, context);
  on_gpu.set_view(glm::dmat4(1.0), std::nullopt);
  on_gpu.bind();
  on_gpu.bind_vertex_textures();
  const gl::Program program =
      link_compute(gl::assemble_shader("technique/triangle_surface.glsl", camera_defines(camera)) + body);
  set_camera(program, {.camera = camera, .worldFromCamera = glm::dmat4(1.0), .tile = {}});
  CameraTextures textures;
  textures.bind(camera);
  std::vector<glm::vec2> pixels;
  for (const Case& made : cases) pixels.emplace_back(made.pixel);
  const gl::Buffer in{std::span<const glm::vec2>(pixels)};
  const gl::Buffer out(cases.size() * sizeof(glm::vec4));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.id());
  program.use();
  glDispatchCompute(GLuint(cases.size() + 63) / 64, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<glm::vec4> changes(cases.size());
  glGetNamedBufferSubData(out.id(), 0, GLsizeiptr(out.bytes()), changes.data());
  return changes;
}

TEST(DerivativesTest, AreThoseOfCentralDifferences) {
  const gl::Context context;
  size_t all = 0, off = 0;
  double worst = 0.0;
  for (const auto& [name, camera] : all_cameras(256)) {
    if (camera.lens() == nullptr) continue;
    const std::vector<Case> cases = random_cases(camera, 400);
    const std::vector<glm::vec4> changes = changes_of(cases, camera, context);
    size_t compared = 0;
    double most = 0.0;
    for (size_t i = 0; i < cases.size(); ++i) {
      const auto dx = change_of(cases[i], camera, {1, 0}), dy = change_of(cases[i], camera, {0, 1});
      if (!dx || !dy) continue;
      ++compared;
      const glm::dvec4 expected(*dx, *dy);
      const double error = glm::distance(glm::dvec4(changes[i]), expected) / glm::length(expected);
      most = std::max(most, error);
      off += error > 1e-4;
    }
    std::cout << fmt::format("{}: {} of {} compared, off by up to {:.1e}\n", name, compared, cases.size(), most);
    all += compared;
    worst = std::max(worst, most);
  }
  std::cout << fmt::format("{} of {} off by more than 1e-4, at most {:.1e}\n", off, all, worst);
  EXPECT_GT(all, 10000u);
  // What is beyond is single precision where a triangle is seen at a grazing angle.
  EXPECT_LT(off, all / 100);
  EXPECT_LT(worst, 1e-3);
}

}  // namespace
}  // namespace omma
