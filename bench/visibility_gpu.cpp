#include "bench/visibility_gpu.h"

#include <fmt/core.h>

#include <chrono>
#include <optional>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/math/pose.h"
#include "omma/technique/visibility/gpu_finder.h"
#include "omma/visibility/finder.h"

namespace omma::bench {
namespace {

struct Case {
  const char* scene;
  const char* camera;
  ImageSize size;
};

constexpr Case cases[] = {
    {"city", "equidistant:fov_deg=180", {800, 600}},    {"city", "equirectangular", {1024, 512}},
    {"city", "equidistant:fov_deg=180", {1600, 1200}},  {"city:blocks=16", "equidistant:fov_deg=180", {800, 600}},
    {"terrain", "equidistant:fov_deg=180", {800, 600}}, {"room", "equidistant:fov_deg=180", {800, 600}},
};

/// Milliseconds that `work` takes.
template <typename Work>
double timed(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

nlohmann::json measure(const gl::Context& context, const Case& tested, const Options& options) {
  const Scene scene = load_scene(tested.scene);
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  const Camera camera = make_camera(tested.camera, tested.size);
  const RayTree tree(rays_of(camera));
  const GpuScene gpu_scene(scene, context);
  ProgramCache programs;
  const LazySceneIndex index(scene);
  DrawTools tools{context, gpu_scene, index, programs};
  const GpuRays rays(tree, context.limits());
  GpuFinder gpu(tools);
  gpu.set_view(pose);
  const Finder cpu(index.get(), pose);
  std::vector<glm::uvec2> found(size_t(tested.size.width) * size_t(tested.size.height));
  VisibleTriangles visible;
  const std::vector<std::function<double()>> runs = {
      [&] { return timed([&] { visible = gpu.nearest(rays, Solid::opaque); }); },
      [&] { return timed([&] { cpu.nearest(tree, Solid::opaque, found); }); },
  };
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);
  size_t different = 0;
  for (size_t i = 0; i < found.size(); ++i) different += found[i] != visible.hits[i];
  const double ratio = timings[0].median / timings[1].median;
  const size_t bytes = gpu.bytes() + rays.bytes();
  fmt::print("| `{}` | {} | `{}` | {} x {} | {} | {} | {:.1f} | {:.0f} | {} |\n", tested.scene, scene.triangle_count(),
             tested.camera, tested.size.width, tested.size.height, to_text(timings[0]), to_text(timings[1]), ratio,
             double(bytes) * 1e-6, different);
  std::fflush(stdout);
  return {{"scene", tested.scene},
          {"triangles", scene.triangle_count()},
          {"camera", tested.camera},
          {"width", tested.size.width},
          {"height", tested.size.height},
          {"gpu", to_json(timings[0])},
          {"cpu", to_json(timings[1])},
          {"times_cpu", ratio},
          {"bytes", bytes},
          {"ids_that_differ", different}};
}

}  // namespace

nlohmann::json run_visibility_gpu(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  std::optional<gl::Context> context;
  try {
    context.emplace();
  } catch (const MachineError& error) {
    fmt::print("\nwithout visibility:gpu: {}\n", error.what());
    return rows;
  }
  fmt::print(
      "\nBy compute shaders on {}, the copy back to main memory included:\n\n"
      "| scene | triangles | camera | size | gpu ms (10–90%) | cpu ms | × cpu | MB | ids that differ |\n"
      "|---|---|---|---|---|---|---|---|---|\n",
      context->renderer());
  for (const Case& tested : cases) rows.push_back(measure(*context, tested, options));
  return rows;
}

}  // namespace omma::bench
