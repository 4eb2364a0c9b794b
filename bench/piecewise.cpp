#include "bench/piecewise.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/frame.h"
#include "omma/image/write.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"

namespace omma::bench {
namespace {

constexpr ImageSize size{1600, 1200};

/// A camera texture of the paper's kind, in a file that goes away again: the view bulges and sways, more at some places
/// than at others.
class CameraTextureFile {
 public:
  explicit CameraTextureFile(ImageSize texels)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("omma_bench_{}x{}.npy", texels.width, texels.height)) {
    FloatImage offsets(texels, 2);
    for (int y = 0; y < texels.height; ++y) {
      for (int x = 0; x < texels.width; ++x) {
        const double u = (x + 0.5) / texels.width, v = (y + 0.5) / texels.height;
        const double fade = 16.0 * u * (1.0 - u) * v * (1.0 - v);  // the borders stay
        offsets.at(x, y)[0] = float(0.05 * fade * std::sin(7.0 * v + 2.0 * u));
        offsets.at(x, y)[1] = float(0.05 * fade * std::sin(6.0 * u - 1.0 * v));
      }
    }
    write_image(path_, offsets, Channel::uv);
  }
  ~CameraTextureFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  CameraTextureFile(const CameraTextureFile&) = delete;
  CameraTextureFile& operator=(const CameraTextureFile&) = delete;

  Camera camera() const {
    return make_camera(fmt::format("camera_texture:file={},base=perspective,fov_deg=90", path_.string()), size);
  }

 private:
  std::filesystem::path path_;
};

struct Configuration {
  std::string label;
  Camera camera;
  RenderOptions options;
};

Configuration planar() {
  Configuration planar{"planar, 90°", make_camera("perspective:fov_deg=90", size), {}};
  planar.options.technique = "planar";
  return planar;
}

Configuration image_based(const Camera& camera, const char* variant, int face_size) {
  Configuration result{fmt::format("image-based:{}, {}", variant,
                                   face_size > 0 ? fmt::format("faces of {}²", face_size) : "density of the centre"),
                       camera,
                       {}};
  result.options.technique = fmt::format("image-based:{}", variant);
  result.options.face_size = face_size;
  return result;
}

Configuration piecewise(const Camera& camera, const std::string& variant, const PieceOptions& pieces) {
  Configuration result{"piecewise:" + variant, camera, {}};
  result.options.technique = "piecewise:" + variant;
  result.options.pieces = pieces;
  return result;
}

/// One table. The fastest of the image-based configurations is what others are compared with, and the planar one.
nlohmann::json measure(const std::string& title, const Options& options, const PreparedScene& prepared,
                       const glm::dmat4& pose, std::vector<Configuration> configurations, Filter filter, int samples) {
  std::vector<RenderStats> stats(configurations.size());
  std::vector<std::function<double()>> runs;
  for (size_t i = 0; i < configurations.size(); ++i) {
    configurations[i].options.filter = filter;
    configurations[i].options.samples = samples;
    runs.push_back([&, i] {
      constexpr Channel wanted[] = {Channel::color};
      prepared.render(configurations[i].camera, pose, wanted, configurations[i].options, &stats[i]);
      return frame_ms(stats[i]);
    });
  }
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);
  double planar_ms = 0.0, image_based_ms = 0.0;
  for (size_t i = 0; i < timings.size(); ++i) {
    if (stats[i].technique == "planar") planar_ms = timings[i].median;
    if (stats[i].technique.starts_with("image-based") &&
        (image_based_ms == 0.0 || timings[i].median < image_based_ms)) {
      image_based_ms = timings[i].median;
    }
  }

  fmt::print("\n{}, {}, {} sample{} per pixel\n\n", title, filter_name(filter), samples, samples == 1 ? "" : "s");
  fmt::print(
      "| technique | ms (10–90%) | fps | × best image-based | × planar | pieces | error px | drawn | drawn / in scene "
      "| MB | stages |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  nlohmann::json rows = nlohmann::json::array();
  const auto ratio = [](double ms, double to) { return to > 0.0 ? fmt::format("{:.2f}", ms / to) : "–"; };
  for (size_t i = 0; i < timings.size(); ++i) {
    const RenderStats& s = stats[i];
    const double replication = double(s.triangles_drawn) / double(s.triangles);
    fmt::print("| {} | {} | {:.1f} | {} | {} | {} | {} | {} | {:.2f} | {:.1f} | {} |\n", configurations[i].label,
               to_text(timings[i]), 1000.0 / timings[i].median, ratio(timings[i].median, image_based_ms),
               ratio(timings[i].median, planar_ms), s.pieces > 0 ? std::to_string(s.pieces) : "–",
               s.pieces > 0 ? fmt::format("{:.2f}", s.piece_error_px) : "–", s.triangles_drawn, replication,
               double(s.buffer_bytes) * 1e-6, stages_text(s));
    nlohmann::json row = to_json(timings[i]);
    row["table"] = title;
    row["technique"] = configurations[i].label;
    row["filter"] = filter_name(filter);
    row["samples"] = samples;
    row["pieces"] = s.pieces;
    row["piece_error_px"] = s.piece_error_px;
    row["triangles"] = s.triangles;
    row["triangles_drawn"] = s.triangles_drawn;
    row["replication"] = replication;
    row["buffer_bytes"] = s.buffer_bytes;
    row["stage_ms"] = s.stage_ms;
    if (image_based_ms > 0.0) row["times_image_based"] = timings[i].median / image_based_ms;
    if (planar_ms > 0.0) row["times_planar"] = timings[i].median / planar_ms;
    rows.push_back(row);
  }
  return rows;
}

void append(nlohmann::json& all, const nlohmann::json& rows) {
  for (const nlohmann::json& row : rows) all.push_back(row);
}

/// Table 1: the 360° cylinder in 160 strips, and camera textures.
void run_table(nlohmann::json& all, const Options& options, const PreparedScene& prepared, const glm::dmat4& pose) {
  const Camera cylinder = make_camera("cylinder:fov_deg=360", size);
  std::vector<Configuration> panorama{planar()};
  for (const int face_size : {0, 2048}) {  // the paper's faces are of 2048
    for (const char* variant : {"seen", "layered"}) panorama.push_back(image_based(cylinder, variant, face_size));
  }
  for (const char* variant : {"compute", "feedback", "tessellator", "naive"}) {
    panorama.push_back(piecewise(cylinder, variant, {.count = 160}));
  }
  panorama.push_back(piecewise(cylinder, "compute", {}));
  panorama.back().label += ", tolerance 0.25 px";

  const auto run = [&](const std::string& title, const std::vector<Configuration>& configurations) {
    append(all, measure(title, options, prepared, pose, configurations, Filter::trilinear, 1));
    append(all, measure(title, options, prepared, pose, configurations, Filter::anisotropic, 4));
  };
  run("360° cylinder, 160 pieces", panorama);
  for (const ImageSize texels : {ImageSize{80, 60}, ImageSize{128, 128}}) {
    const CameraTextureFile file(texels);
    const Camera deformed = file.camera();
    std::vector<Configuration> configurations{planar(), image_based(deformed, "seen", 0)};
    for (const char* variant : {"compute", "feedback", "tessellator"}) {
      configurations.push_back(piecewise(deformed, variant, {}));
    }
    configurations.push_back(piecewise(deformed, "compute", {.tolerance_px = 0.5}));
    configurations.back().label += ", tolerance 0.5 px";
    run(fmt::format("camera texture of {} x {}", texels.width, texels.height), configurations);
  }
}

void run_growth_with_pieces(nlohmann::json& all, const Options& options, const PreparedScene& prepared,
                            const glm::dmat4& pose) {
  const Camera fisheye = make_camera("equidistant:fov_deg=180", size);
  for (const int count : {20, 200, 2000, 20000}) {
    std::vector<Configuration> configurations{image_based(fisheye, "seen", 0)};
    for (const char* variant : {"compute", "feedback", "tessellator", "naive"}) {
      if (std::string(variant) == "naive" && count > 200) continue;  // seconds a frame, then minutes
      configurations.push_back(piecewise(fisheye, variant, {.count = count}));
    }
    append(all, measure(fmt::format("180° fisheye in about {} pieces", count), options, prepared, pose, configurations,
                        Filter::trilinear, 1));
  }
}

void run_growth_with_triangles(nlohmann::json& all, const Options& options, const Device& device) {
  const Camera fisheye = make_camera("equidistant:fov_deg=180", size);
  for (const char* name : {"city", "city:blocks=16", "city:blocks=30", "city:blocks=57"}) {
    const PreparedScene prepared(device, load_scene(name));
    const Scene& scene = prepared.scene();
    const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
    std::vector<Configuration> configurations{planar(), image_based(fisheye, "seen", 0)};
    for (const char* variant : {"compute", "feedback", "tessellator"}) {
      configurations.push_back(piecewise(fisheye, variant, {}));
    }
    append(all, measure(fmt::format("180° fisheye, tolerance 0.25 px, {} triangles", scene.triangle_count()), options,
                        prepared, pose, configurations, Filter::trilinear, 1));
  }
}

}  // namespace

nlohmann::json run_piecewise(const Options& options) {
  const Scene scene = load_scene("city");
  const Device device;
  const PreparedScene prepared(device, scene);
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  fmt::print("Scene `city`, {} triangles, {} materials, {} x {}.\n", scene.triangle_count(), scene.materials.size(),
             size.width, size.height);
  nlohmann::json all = nlohmann::json::array();
  run_table(all, options, prepared, pose);
  run_growth_with_pieces(all, options, prepared, pose);
  run_growth_with_triangles(all, options, device);
  return all;
}

}  // namespace omma::bench
