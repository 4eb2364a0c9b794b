#include "bench/visibility.h"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "bench/flat_embree.h"
#include "bench/frame.h"
#include "bench/visibility_frames.h"
#include "bench/visibility_gpu.h"
#include "omma/camera/ray_bundle.h"
#include "omma/math/pose.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/finder.h"

namespace omma::bench {
namespace {

struct Place {
  std::string scene;
  std::string name;
  bool above = false;  ///< over the scene's middle, looking down
};

struct Case {
  Place place;
  std::string camera;
  ImageSize size{1600, 1200};
};

/// Milliseconds that `work` takes.
template <typename Work>
double timed(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

glm::dmat4 pose_of(const Scene& scene, bool above) {
  if (!above) return look_at_worldFromCamera(scene.default_from, scene.default_to);
  const Bounds bounds = scene.bounds();
  // As high as the town is wide around the default place: all of it below, none of it larger than a few pixels.
  const glm::dvec3 middle(scene.default_to.x, bounds.min.y, scene.default_to.z);
  return look_at_worldFromCamera(middle + glm::dvec3(0.0, 250.0, 0.0), middle, {0.0, 0.0, -1.0});
}

/// What a scene is measured with; built once for all its cameras and places.
struct Subject {
  explicit Subject(const std::string& name) : scene(load_scene(name)) {
    // As if every vertex moved with every frame.
    for (Mesh& mesh : scene.meshes) mesh.rest_positions = mesh.positions;
    sort_ms = timed([&] { index = std::make_unique<SceneIndex>(scene); });
  }
  Scene scene;
  std::unique_ptr<SceneIndex> index;
  double sort_ms = 0.0;
};

size_t different(std::span<const glm::uvec2> a, std::span<const glm::uvec2> b) {
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) count += a[i].x != b[i].x;
  return count;
}

nlohmann::json measure(Subject& subject, const Case& tested, const Options& options) {
  const Camera camera = make_camera(tested.camera, tested.size);
  const glm::dmat4 pose = pose_of(subject.scene, tested.place.above);
  const RayMap rays = rays_of(camera);
  std::unique_ptr<RayTree> tree;
  const double tree_ms = timed([&] { tree = std::make_unique<RayTree>(rays); });
  std::unique_ptr<FlatEmbree> embree;
  const double build_ms = timed([&] { embree = std::make_unique<FlatEmbree>(subject.scene, pose); });
  SceneChanges all{.moved = true};
  for (size_t m = 0; m < subject.scene.meshes.size(); ++m) {
    if (subject.scene.meshes[m].deforms()) all.deformed.insert(int(m));
  }
  const double refit_ms = timed([&] { subject.index->update(all); });
  std::optional<Finder> finder;
  const double place_ms = timed([&] { finder.emplace(*subject.index, pose); });
  std::vector<glm::uvec2> found(rays.directions.size()), traced(found.size());
  const std::vector<std::function<double()>> runs = {
      [&] { return timed([&] { finder->nearest(*tree, Solid::opaque, found); }); },
      [&] { return timed([&] { embree->nearest(rays.directions, rays.size.width, traced); }); },
  };
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);
  const double ratio = timings[0].median / timings[1].median;
  const double ratio_anew = (timings[0].median + refit_ms + place_ms) / (timings[1].median + build_ms);
  const double megapixels = megapixels_seen(camera);
  fmt::print(
      "| {} | {} | `{}` | {} x {} | {} | {} | {:.2f} | {:.0f} | {:.1f} | {:.0f} | {:.2f} | {:.0f} | {:.1f} | {:.0f} | "
      "{} |\n",
      tested.place.name, subject.scene.triangle_count(), tested.camera, tested.size.width, tested.size.height,
      to_text(timings[0]), to_text(timings[1]), ratio, timings[0].median / megapixels, refit_ms + place_ms, build_ms,
      ratio_anew, subject.sort_ms, tree_ms, double(subject.index->bytes() + tree->bytes()) * 1e-6,
      different(found, traced));
  std::fflush(stdout);
  return {{"scene", tested.place.scene},
          {"place", tested.place.name},
          {"triangles", subject.scene.triangle_count()},
          {"camera", tested.camera},
          {"width", tested.size.width},
          {"height", tested.size.height},
          {"find", to_json(timings[0])},
          {"embree", to_json(timings[1])},
          {"times_embree", ratio},
          {"refit_ms", refit_ms},
          {"embree_build_ms", build_ms},
          {"times_embree_anew", ratio_anew},
          {"sort_ms", subject.sort_ms},
          {"ray_tree_ms", tree_ms},
          {"place_ms", place_ms},
          {"finder_bytes", subject.index->bytes()},
          {"ray_tree_bytes", tree->bytes()},
          {"ids_that_differ", different(found, traced)}};
}

void print_header() {
  fmt::print(
      "\n| view | triangles | camera | size | find ms (10–90%) | Embree ms | × Embree | ns per pixel with a ray | "
      "refit ms "
      "| Embree build ms | × Embree, every frame anew | sort ms, once | ray tree ms, once | MB | ids that differ |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

}  // namespace

nlohmann::json run_visibility(const Options& options) {
  if (!options.scene.empty()) load_scene(options.scene);  // fails before anything slow
  fmt::print("{}, {} threads. Both find each ray's triangle and instance; Embree's tree is built.\n",
             simd_targets().front(), std::thread::hardware_concurrency());
  print_header();
  nlohmann::json rows = nlohmann::json::array();
  for (const char* name : {"city", "city:blocks=16", "city:blocks=30", "city:blocks=57"}) {
    Subject subject(name);
    for (const bool above : {false, true}) {
      const Place place{name, above ? "city from above" : "city, street", above};
      rows.push_back(measure(subject, {place, "equidistant:fov_deg=180"}, options));
      if (above || std::string(name) != "city:blocks=16") continue;
      for (const char* camera : {"equidistant:fov_deg=220", "cylinder:fov_deg=360", "equirectangular"}) {
        const bool sphere = std::string(camera) == "equirectangular";
        rows.push_back(
            measure(subject, {place, camera, sphere ? ImageSize{2048, 1024} : ImageSize{1600, 1200}}, options));
      }
      rows.push_back(measure(subject, {place, "equidistant:fov_deg=180", {4096, 4096}}, options));
    }
  }
  for (const char* name : {"terrain:triangles=2000000", "room", "temple"}) {
    Subject subject(name);
    rows.push_back(measure(subject, {{name, name}, "equidistant:fov_deg=180"}, options));
  }
  const nlohmann::json by_gpu = run_visibility_gpu(options);
  return {{"finding", rows}, {"finding_by_gpu", by_gpu}, {"frames", run_visibility_frames(options)}};
}

}  // namespace omma::bench
