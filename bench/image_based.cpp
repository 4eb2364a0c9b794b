#include "bench/image_based.h"

#include <fmt/core.h>

#include <algorithm>

#include "bench/frame.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"

namespace omma::bench {
namespace {

struct Configuration {
  const char* camera;
  const char* technique;
};

/// The first is the baseline.
constexpr Configuration configurations[] = {
    {"perspective:fov_deg=90", "planar"},
    {"equidistant:fov_deg=180", "image-based:passes"},
    {"equidistant:fov_deg=180", "image-based:layered"},
    {"equidistant:fov_deg=180", "image-based:seen"},
    {"equidistant:fov_deg=180", "vertex"},
    {"equidistant:fov_deg=180", "raycast"},
    {"cylinder:fov_deg=360", "image-based:passes"},
    {"cylinder:fov_deg=360", "image-based:layered"},
    {"cylinder:fov_deg=360", "image-based:seen"},
    {"cylinder:fov_deg=360", "raycast"},
};

nlohmann::json run_filter(const Options& options, const Scene& scene, const PreparedScene& prepared, Filter filter,
                          int samples) {
  constexpr ImageSize size{1600, 1200};
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  std::vector<Camera> cameras;
  std::vector<std::function<double()>> runs;
  std::vector<RenderStats> stats(std::size(configurations));
  cameras.reserve(std::size(configurations));
  for (size_t i = 0; i < std::size(configurations); ++i) {
    cameras.push_back(make_camera(configurations[i].camera, size));
    runs.push_back([&, i] {
      RenderOptions render_options;
      render_options.technique = configurations[i].technique;
      render_options.filter = filter;
      render_options.samples = samples;
      constexpr Channel wanted[] = {Channel::color};
      prepared.render(cameras[i], pose, wanted, render_options, &stats[i]);
      return frame_ms(stats[i]);
    });
  }
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);

  fmt::print("\n{} x {}, {}, {} sample{} per pixel\n\n", size.width, size.height, filter_name(filter), samples,
             samples == 1 ? "" : "s");
  fmt::print(
      "| camera | technique | ms (10–90%) | × planar | ns per pixel with a ray | × planar | drawn / in scene | stages "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  nlohmann::json rows = nlohmann::json::array();
  double baseline_per_pixel = 0.0;
  for (size_t i = 0; i < timings.size(); ++i) {
    const double per_pixel = timings[i].median / megapixels_seen(cameras[i]);
    if (i == 0) baseline_per_pixel = per_pixel;
    const double drawn = double(stats[i].triangles_drawn) / double(stats[i].triangles);
    fmt::print("| {} | {} | {} | {:.2f} | {:.0f} | {:.2f} | {:.2f} | {} |\n", configurations[i].camera,
               configurations[i].technique, to_text(timings[i]), timings[i].median / timings[0].median, per_pixel,
               per_pixel / baseline_per_pixel, drawn, stages_text(stats[i]));
    nlohmann::json row = to_json(timings[i]);
    row["camera"] = configurations[i].camera;
    row["technique"] = configurations[i].technique;
    row["filter"] = filter_name(filter);
    row["samples"] = samples;
    row["times_planar"] = timings[i].median / timings[0].median;
    row["ns_per_pixel"] = per_pixel;
    row["stage_ms"] = stats[i].stage_ms;
    row["buffer_bytes"] = stats[i].buffer_bytes;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

nlohmann::json run_image_based(const Options& options) {
  const Scene scene = load_scene("city");
  const PreparedScene prepared(Device(), scene);
  fmt::print("Scene `city`, {} triangles.\n", scene.triangle_count());
  nlohmann::json result = nlohmann::json::array();
  for (Filter filter : {Filter::trilinear, Filter::anisotropic}) {
    for (int samples : {1, 4}) {
      for (auto& row : run_filter(options, scene, prepared, filter, samples)) result.push_back(row);
    }
  }
  return result;
}

}  // namespace omma::bench
