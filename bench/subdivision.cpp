#include "bench/subdivision.h"

#include <fmt/core.h>

#include "bench/frame.h"
#include "omma/image/compare.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"

namespace omma::bench {
namespace {

constexpr ImageSize size{1024, 768};
constexpr const char* lens = "equidistant:fov_deg=180";
constexpr const char* planar = "planar";
/// Planar pictures first: the baseline.
constexpr const char* drawn[] = {planar,   "image-based:passes",   "image-based:layered",     "image-based:seen",
                                 "vertex", "subdivision:feedback", "subdivision:tessellator", "nonlinear:hybrid"};
constexpr int sizes[] = {120'000, 500'000, 2'000'000};

struct Frame {
  std::string technique;
  Camera camera;
  RenderStats stats{};
};

/// Share of pixels that show another triangle than a ray meets.
double wrong_ids(const PreparedScene& prepared, const Frame& frame, const glm::dmat4& pose) {
  constexpr Channel wanted[] = {Channel::id};
  const auto ids = [&](const std::string& technique) {
    return std::get<IntImage>(prepared.render(frame.camera, pose, wanted, {.technique = technique}).at(Channel::id));
  };
  return compare_images(ids(frame.technique), ids("raycast"), Scale::raw).mismatch_share;
}

void run_scene(nlohmann::json& rows, const Options& options, int triangles) {
  const Scene scene = load_scene(fmt::format("terrain:triangles={}", triangles));
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  const PreparedScene prepared(Device(), scene);
  std::vector<Frame> frames;
  for (const char* technique : drawn) {
    frames.push_back({technique, make_camera(technique == planar ? "perspective:fov_deg=90" : lens, size)});
  }
  std::vector<std::function<double()>> runs;
  for (Frame& frame : frames) {
    runs.push_back([&] {
      constexpr Channel wanted[] = {Channel::color};
      const RenderOptions render{.technique = frame.technique, .samples = 1, .filter = Filter::trilinear};
      prepared.render(frame.camera, pose, wanted, render, &frame.stats);
      return frame_ms(frame.stats);
    });
  }
  const std::vector<std::vector<double>> times = times_in_turn(runs, options.runs);

  size_t images = 1;  // the fastest of the image-based
  for (size_t i = 1; i < frames.size() && frames[i].technique.starts_with("image-based"); ++i) {
    if (timing_of(times[i]).median < timing_of(times[images]).median) images = i;
  }
  fmt::print("\nterrain, {} triangles, {} x {}\n\n", scene.triangle_count(), size.width, size.height);
  fmt::print(
      "| technique | ms (10–90%) | × planar | × best image-based | triangles drawn, thousands | wrong ids | stages |\n"
      "|---|---|---|---|---|---|---|\n");
  for (size_t i = 0; i < frames.size(); ++i) {
    const Frame& frame = frames[i];
    const Timing timing = timing_of(times[i]), to_planar = ratio_of(times[i], times[0]),
                 to_images = ratio_of(times[i], times[images]);
    const double wrong = wrong_ids(prepared, frame, pose);
    fmt::print("| {} | {} | {} | {} | {:.0f} | {:.2f}% | {} |\n", frame.technique, to_text(timing),
               ratio_text(to_planar), ratio_text(to_images), 1e-3 * double(frame.stats.triangles_drawn), 100.0 * wrong,
               stages_text(frame.stats));
    nlohmann::json row = to_json(timing);
    row["triangles"] = scene.triangle_count();
    row["technique"] = frame.technique;
    row["times_planar"] = to_planar.median;
    row["times_best_image_based"] = to_images.median;
    row["triangles_drawn"] = frame.stats.triangles_drawn;
    row["wrong_ids"] = wrong;
    row["stage_ms"] = frame.stats.stage_ms;
    rows.push_back(row);
  }
  std::fflush(stdout);
}

}  // namespace

nlohmann::json run_subdivision(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  for (const int triangles : sizes) run_scene(rows, options, triangles);
  return rows;
}

}  // namespace omma::bench
