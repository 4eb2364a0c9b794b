// Random triangles and cameras for whoever finds which triangle a ray meets: the processor on each SIMD target and,
// where a GL context is at hand, the GPU. On a grid, where products are exact, every ray's triangle is the one that
// brute force in double precision says, but for rays 1e-3 px from an edge and depth ties; with coordinates of any bits
// whatever is found exists.
#include <fmt/core.h>
#include <fuzzer/FuzzedDataProvider.h>

#include <bit>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/technique/visibility/gpu_finder.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/finder.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/oracle.h"

namespace {

using namespace omma;

std::unique_ptr<gl::Context> context;

/// Nothing for images so small that none has the lens's shape.
std::optional<Camera> take_camera(FuzzedDataProvider& data) {
  const LensModel& model = lens_models()[data.ConsumeIntegralInRange<size_t>(0, lens_models().size() - 1)];
  const ImageSize own = make_camera(model.info.example).size();
  const double scale = data.ConsumeIntegralInRange(1, 40) / double(std::max(own.width, own.height));
  const ImageSize size{std::max(1, int(std::lround(scale * own.width))),
                       std::max(1, int(std::lround(scale * own.height)))};
  try {
    return make_camera(model.info.example, size);
  } catch (const CommandError&) {
    return {};
  }
}

/// Along the axes, moved by whole steps of the grid: single precision rounds nothing.
glm::dmat4 take_transform(FuzzedDataProvider& data) {
  const int first = data.ConsumeIntegralInRange(0, 2), second = (first + data.ConsumeIntegralInRange(1, 2)) % 3;
  glm::dmat4 transform(0.0);
  transform[0][first] = data.ConsumeBool() ? 1.0 : -1.0;
  transform[1][second] = data.ConsumeBool() ? 1.0 : -1.0;
  transform[2][3 - first - second] = data.ConsumeBool() ? 1.0 : -1.0;
  for (int axis = 0; axis < 3; ++axis) transform[3][axis] = data.ConsumeIntegralInRange(-8, 8);
  transform[3][3] = 1.0;
  return transform;
}

Scene take_scene(FuzzedDataProvider& data, bool on_grid) {
  const float step = std::ldexp(1.0f, on_grid ? data.ConsumeIntegralInRange(-20, 20) : 0);
  const auto coordinate = [&] {
    return on_grid ? step * float(data.ConsumeIntegralInRange(-15, 15))
                   : std::bit_cast<float>(data.ConsumeIntegral<uint32_t>());
  };
  SceneMaker maker;
  const int meshes = data.ConsumeIntegralInRange(1, 3);
  for (int m = 0; m < meshes; ++m) {
    Material material;
    material.double_sided = data.ConsumeBool();
    Mesh mesh;
    mesh.material = maker.add(material);
    const auto corners = data.ConsumeIntegralInRange<uint32_t>(3, 12);
    for (uint32_t i = 0; i < corners; ++i) {
      glm::vec3& position = mesh.positions.emplace_back();
      for (int axis = 0; axis < 3; ++axis) position[axis] = coordinate();
    }
    mesh.normals.assign(corners, {0, 0, 1});
    const int triangles = data.ConsumeIntegralInRange(1, 40);
    const auto corner = [&] { return data.ConsumeIntegralInRange<uint32_t>(0, corners - 1); };
    for (int t = 0; t < triangles; ++t) {
      const uint32_t a = corner(), b = corner();
      mesh.triangles.emplace_back(a, b, corner());
    }
    const int number = maker.add(mesh);
    const int places = data.ConsumeIntegralInRange(1, 2);
    for (int p = 0; p < places; ++p) {
      glm::dmat4 transform = take_transform(data);
      transform[3] *= glm::dvec4(glm::dvec3(step), 1.0);
      maker.place(number, transform);
    }
  }
  return maker.finish();
}

IntImage ids_of(const std::vector<glm::uvec2>& hits, ImageSize size) {
  IntImage ids(size, 1);
  for (size_t i = 0; i < hits.size(); ++i) ids.values[i] = int32_t(hits[i].x);
  return ids;
}

void expect(bool is_so, const std::string& what) {
  if (is_so) return;
  std::cerr << what << '\n';
  std::abort();
}

/// All triangles as the camera sees them.
std::string to_text(const Scene& scene) {
  std::string text;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      text += fmt::format("\n{}:", instance.first_triangle + t);
      for (int c = 0; c < 3; ++c) {
        const glm::dvec3 p(instance.worldFromObject * glm::dvec4(mesh.positions[mesh.triangles[t][c]], 1.0));
        text += fmt::format(" ({:g}, {:g}, {:g})", p.x, p.y, p.z);
      }
      if (scene.materials[size_t(mesh.material)].double_sided) text += " double-sided";
    }
  }
  return text;
}

void check_exists(const Scene& scene, const std::vector<glm::uvec2>& hits) {
  for (const glm::uvec2& hit : hits) {
    if (hit.x == meets_nothing) continue;
    expect(hit.y < scene.instances.size(), "a triangle of no instance");
    const Instance& instance = scene.instances[hit.y];
    expect(hit.x - instance.first_triangle < scene.meshes[size_t(instance.mesh)].triangles.size(),
           "a triangle of another instance");
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  try {
    context = std::make_unique<gl::Context>();
  } catch (const MachineError& error) {
    std::cerr << "without the GPU: " << error.what() << '\n';
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  FuzzedDataProvider data(bytes, size);
  const bool on_grid = data.ConsumeIntegralInRange(0, 3) != 0;
  const std::optional<Camera> taken = take_camera(data);
  if (!taken) return -1;
  const Camera& camera = *taken;
  const Scene scene = take_scene(data, on_grid);
  const RayMap rays = rays_of(camera);
  const RayTree tree(rays);
  const Oracle oracle(scene, glm::dmat4(1.0));
  std::optional<IntImage> agreed;
  const auto check = [&](const std::string& finder, const std::vector<glm::uvec2>& hits) {
    check_exists(scene, hits);
    if (!on_grid) return;
    const IntImage ids = ids_of(hits, camera.size());
    const Verdict verdict = judge(oracle, camera, ids, {.radius = 1e-3}, agreed ? &*agreed : nullptr);
    if (verdict.wrong > 0)
      expect(false, finder + ": " + verdict.first_wrong + " through " + to_text(camera) + to_text(scene));
    if (!agreed) agreed = ids;
  };
  const LazySceneIndex index(scene);
  const Finder finder(index.get(), glm::dmat4(1.0));
  std::vector<glm::uvec2> hits(rays.directions.size());
  for (const std::string& target : simd_targets()) {
    use_simd_target(target);
    finder.nearest(tree, Solid::opaque, hits);
    check(target, hits);
  }
  use_simd_target("");
  if (context == nullptr) return 0;
  const GpuScene gpu_scene(scene, *context);
  ProgramCache programs;
  DrawTools tools{*context, gpu_scene, index, programs};
  GpuFinder gpu(tools);
  gpu.set_view(glm::dmat4(1.0));
  check("gpu", gpu.nearest(GpuRays(tree, context->limits()), Solid::opaque).hits);
  return 0;
}
