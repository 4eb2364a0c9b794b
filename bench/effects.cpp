#include "bench/effects.h"

#include <fmt/core.h>

#include <optional>

#include "bench/measure_lines.h"
#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"

namespace omma::bench {
namespace {

constexpr ImageSize size{1600, 1200};
constexpr double line_px = 2.0, stroke_px = 2.0, spacing_px = 12.0;

/// Flat, fisheye, panorama, and a view deformed at will.
constexpr const char* cameras[] = {
    "perspective:fov_deg=100",
    "equidistant:fov_deg=180",
    "cylinder:fov_deg=360",
    "expression:longitude=1.2*u+0.3*sin(3*v),latitude=0.9*v+0.25*sin(4*u)",
};

/// `vertex` draws edges elsewhere than they are: there is nothing to measure.
std::vector<std::string> compared() {
  std::vector<std::string> names{"raycast"};
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.name != "raycast" && technique.name != "vertex") names.push_back(technique.name);
  }
  return names;
}

struct Measured {
  Spread line, spacing, stroke;
};

/// Nothing where the technique cannot draw the camera.
std::optional<Measured> measure(const PreparedScene& white, const PreparedScene& black, const Camera& camera,
                                const glm::dmat4& pose, const std::string& technique) {
  const auto draw = [&](const PreparedScene& scene, const char* scene_technique, Channel channel,
                        const std::string& effect) {
    RenderOptions options;
    options.technique = scene_technique;
    if (!effect.empty()) options.effects.push_back(make_effect(effect));
    const Channel wanted[] = {channel};
    return std::get<FloatImage>(scene.render(camera, pose, wanted, options).at(channel));
  };
  try {
    const FloatImage wires =
        draw(white, technique.c_str(), Channel::color, fmt::format("wireframe:width_px={}", line_px));
    const FloatImage hatched =
        draw(black, technique.c_str(), Channel::color,
             fmt::format("hatching:width_px={},spacing_px={},crossing=1", stroke_px, spacing_px));
    const FloatImage uv = draw(black, "raycast", Channel::uv, "");
    const Strokes strokes = measure_strokes(hatched, uv);
    return Measured{spread_of(edge_line_widths(wires, white.scene(), camera, pose)), spread_of(strokes.spacings),
                    spread_of(strokes.widths)};
  } catch (const CommandError&) {
    return std::nullopt;
  }
}

double ratio(const Spread& spread) { return spread.high / spread.low; }

nlohmann::json to_json(const Spread& spread) {
  return {{"count", spread.count}, {"p5_px", spread.low}, {"median_px", spread.median}, {"p95_px", spread.high}};
}

std::string to_text(const Spread& spread, const Spread& baseline) {
  return fmt::format("{:.2f} ({:.2f}–{:.2f}) | {:.2f} | {:.2f}", spread.median, spread.low, spread.high, ratio(spread),
                     ratio(spread) / ratio(baseline));
}

}  // namespace

nlohmann::json run_effects(const Options&) {
  fmt::print(
      "A ball of triangles from within, {} x {}, 4 samples per pixel. Asked for: lines of {} px along the triangles'\n"
      "edges; strokes of {} px, {} px apart. Median (5–95% over the image), the 95th percentile over the 5th, and "
      "that\n"
      "against `raycast`.\n\n",
      size.width, size.height, line_px, stroke_px, spacing_px);
  fmt::print(
      "| camera | technique | line px | 95/5 | × raycast | stroke spacing px | 95/5 | × raycast | stroke px | 95/5 | × "
      "raycast |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  // Off the ball's centre and tilted: lines at many distances and angles.
  const glm::dmat4 pose = look_at_worldFromCamera({1.5, 0.8, 1.0}, {-1.0, 0.3, -2.0}, {0.3, 1.0, 0.1});
  const Device device;
  const PreparedScene white(device, make_measuring_ball(1.0f)), black(device, make_measuring_ball(0.0f));
  nlohmann::json rows = nlohmann::json::array();
  for (const char* text : cameras) {
    const Camera camera = make_camera(text, size);
    std::optional<Measured> baseline;
    for (const std::string& technique : compared()) {
      const std::optional<Measured> measured = measure(white, black, camera, pose, technique);
      if (!measured) continue;
      if (!baseline) baseline = measured;
      fmt::print("| `{}` | {} | {} | {} | {} |\n", text, technique, to_text(measured->line, baseline->line),
                 to_text(measured->spacing, baseline->spacing), to_text(measured->stroke, baseline->stroke));
      rows.push_back({{"camera", text},
                      {"technique", technique},
                      {"line", to_json(measured->line)},
                      {"stroke_spacing", to_json(measured->spacing)},
                      {"stroke", to_json(measured->stroke)}});
    }
  }
  return rows;
}

}  // namespace omma::bench
