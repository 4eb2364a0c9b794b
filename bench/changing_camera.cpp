#include "bench/changing_camera.h"

#include <fmt/core.h>

#include "bench/frame.h"
#include "omma/math/pose.h"
#include "omma/scene/scene.h"

namespace omma::bench {
namespace {

constexpr ImageSize size{1600, 1200};

struct Change {
  const char* name;
  /// The camera of a frame, its number in {0}.
  const char* text;
};
constexpr Change changes[] = {
    {"a field of view that grows", "equidistant:fov_deg=180.{0:02}"},
    {"a calibrated lens that zooms",
     "opencv_fisheye:f=5{0:02},cx=800,cy=600,width=1600,height=1200,k1=0.0035,k2=0.0007,k3=-0.0021,k4=0.0002"},
    {"a dome that turns", "equidistant:fov_deg=180,yaw_deg={0}"},
    {"a panorama that tilts", "equirectangular:pitch_deg={0}"},
    {"a formula that moves", "expression:longitude=1.2*u+0.3*sin(3*v+{0}),latitude=0.9*v+0.25*sin(4*u)"},
};
constexpr const char* drawn[] = {"visibility:cpu", "image-based"};

/// Each frame of it shows another camera, or the first one again; returns the milliseconds of drawing alone.
struct Sequence {
  const PreparedScene& prepared;
  const Scene& scene;
  const Change& change;
  std::string technique;
  int samples;
  bool changes;
  int frame = 0;

  double next() {
    frame = changes ? (frame + 1) % 100 : 0;
    const Camera camera = make_camera(fmt::format(fmt::runtime(change.text), frame), size);
    RenderOptions options;
    options.technique = technique;
    options.samples = samples;
    constexpr Channel wanted[] = {Channel::color};
    RenderStats stats;
    prepared.render(camera, look_at_worldFromCamera(scene.default_from, scene.default_to), wanted, options, &stats);
    return frame_ms(stats);
  }
};

}  // namespace

nlohmann::json run_changing_camera(const Options& options) {
  const std::string name = options.scene.empty() ? "city" : options.scene;
  const Scene scene = load_scene(name);
  const PreparedScene prepared(Device(), scene);
  fmt::print("{}, {} x {}; making the camera is not counted.\n\n", name, size.width, size.height);
  fmt::print(
      "| camera | technique | samples | stands still, ms (10–90%) | changes, ms | × |\n|---|---|---|---|---|---|\n");
  nlohmann::json rows = nlohmann::json::array();
  for (const Change& change : changes) {
    for (const int samples : {1, 4}) {
      std::vector<Sequence> sequences;
      for (const char* technique : drawn) {
        for (const bool moves : {false, true}) {
          sequences.push_back({prepared, scene, change, technique, samples, moves});
        }
      }
      std::vector<std::function<double()>> runs;
      for (Sequence& sequence : sequences) runs.emplace_back([&sequence] { return sequence.next(); });
      const std::vector<std::vector<double>> times = times_in_turn(runs, options.runs);
      for (size_t i = 0; i < times.size(); i += 2) {
        const Timing still = timing_of(times[i]), moving = timing_of(times[i + 1]);
        const Timing ratio = ratio_of(times[i + 1], times[i]);
        fmt::print("| {} | `{}` | {} | {} | {} | {} |\n", change.name, sequences[i].technique, samples, to_text(still),
                   to_text(moving), ratio_text(ratio));
        std::fflush(stdout);
        rows.push_back({{"camera", change.name},
                        {"technique", sequences[i].technique},
                        {"samples", samples},
                        {"still", to_json(still)},
                        {"changing", to_json(moving)},
                        {"ratio", to_json(ratio)}});
      }
    }
  }
  return {{"changing_camera", rows}};
}

}  // namespace omma::bench
