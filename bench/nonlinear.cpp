#include "bench/nonlinear.h"

#include <fmt/core.h>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/direct_drawing.h"
#include "omma/math/pose.h"
#include "omma/scene/scene.h"

namespace omma::bench {
namespace {

constexpr const char* variants[] = {"triangle", "quad", "hybrid"};

struct Frame {
  std::string label;
  std::vector<Pass> passes;
};

double ratio_of(const Timing& timing, const Timing& baseline) { return timing.median / baseline.median; }

/// Turned to the right and up, degrees.
glm::dmat4 turned(const glm::dmat4& pose, double yaw, double pitch) {
  return glm::rotate(glm::rotate(pose, glm::radians(-yaw), {0, 1, 0}), glm::radians(pitch), {1, 0, 0});
}

Frame flat_faces(const glm::dmat4& pose, int side, bool half) {
  Frame frame{half ? "5 faces of a hemicube, planar" : "6 faces of a cube, planar", {}};
  const ImageSize size{side, side};
  const Camera whole = make_camera("perspective:fov_deg=90", size);
  frame.passes.push_back({whole, pose, "planar"});
  // A half face: its rows nearest to the front.
  const auto side_face = [&](double yaw, double pitch) {
    const std::string text = pitch == 0.0 ? fmt::format("perspective:f={0},cx={1},cy={0},width={0},height={2}",
                                                        side / 2.0, yaw > 0.0 ? side / 2.0 : 0.0, side)
                                          : fmt::format("perspective:f={0},cx={0},cy={1},width={2},height={0}",
                                                        side / 2.0, pitch > 0.0 ? 0.0 : side / 2.0, side);
    const Camera camera = half ? make_camera(text) : whole;
    frame.passes.push_back({camera, turned(pose, yaw, pitch), "planar"});
  };
  side_face(90.0, 0.0);
  side_face(-90.0, 0.0);
  side_face(0.0, 90.0);
  side_face(0.0, -90.0);
  if (!half) frame.passes.push_back({whole, turned(pose, 180.0, 0.0), "planar"});
  return frame;
}

Frame curved(const std::string& label, const std::string& lens, const std::string& technique, const glm::dmat4& pose,
             int side, bool both = false) {
  const Camera camera = make_camera(lens, ImageSize{side, side});
  Frame frame{fmt::format("{}, {}", label, technique), {{camera, pose, technique}}};
  if (both) frame.passes.push_back({camera, turned(pose, 180.0, 0.0), technique});
  return frame;
}

/// Table 2. The first of the frames is what the others are compared with.
void compare_outputs(nlohmann::json& rows, const Options& options, DirectDrawing& drawing, const std::string& title,
                     const std::vector<Frame>& frames) {
  constexpr Output outputs[] = {Output::color, Output::depth, Output::coverage};
  constexpr const char* names[] = {"color", "depth", "coverage"};
  std::vector<std::function<double()>> runs;
  for (const Frame& frame : frames) {
    for (const Output output : outputs) {
      runs.push_back([&, output] { return drawing.draw(frame.passes, {.output = output}); });
    }
  }
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);
  fmt::print("\n{}\n\n| frame | colour ms | × | depth ms | × | coverage ms | × |\n|---|---|---|---|---|---|---|\n",
             title);
  for (size_t i = 0; i < frames.size(); ++i) {
    fmt::print("| {} |", frames[i].label);
    nlohmann::json row{{"table", title}, {"frame", frames[i].label}};
    for (size_t k = 0; k < 3; ++k) {
      const Timing& timing = timings[3 * i + k];
      fmt::print(" {} | {:.2f} |", to_text(timing), ratio_of(timing, timings[k]));
      row[names[k]] = to_json(timing);
      row[names[k]]["times_flat"] = ratio_of(timing, timings[k]);
    }
    fmt::print("\n");
    rows.push_back(row);
  }
}

void run_table_2(nlohmann::json& rows, const Options& options) {
  const Scene scene = load_scene("facade:detail=1");
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  DirectDrawing drawing(scene);
  for (const int side : {512, 16}) {
    std::vector<Frame> all{flat_faces(pose, side, false)}, half{flat_faces(pose, side, true)};
    for (const char* variant : variants) {
      const std::string technique = std::string("nonlinear:") + variant;
      all.push_back(curved("2 paraboloids", "stereographic:fov_deg=180", technique, pose, side, true));
      half.push_back(curved("paraboloid", "stereographic:fov_deg=180", technique, pose, side));
      half.push_back(curved("sphere map", "orthographic_fisheye:fov_deg=180", technique, pose, side));
      half.push_back(curved("Lambert", "equisolid:fov_deg=180", technique, pose, side));
    }
    const std::string text = fmt::format("facade, {} triangles, {}²", scene.triangle_count(), side);
    compare_outputs(rows, options, drawing, text + ", all directions", all);
    compare_outputs(rows, options, drawing, text + ", half of them", half);
  }
}

/// A scene as it is, and without textures.
struct DegradedScene {
  Scene plain, untextured;
  explicit DegradedScene(const std::string& name) : plain(load_scene(name)), untextured(plain) {
    for (Material& material : untextured.materials) {
      material.base_color_texture = material.normal_texture = -1;
      material.metallic_roughness_texture = material.emissive_texture = -1;
    }
  }
};

/// Table 3. The first of the frames is the baseline.
void run_steps(nlohmann::json& rows, const Options& options, const std::string& scene_name,
               const std::function<std::vector<Frame>(const glm::dmat4& pose)>& frames_of) {
  const DegradedScene scene(scene_name);
  const glm::dmat4 pose = look_at_worldFromCamera(scene.plain.default_from, scene.plain.default_to);
  const std::vector<Frame> frames = frames_of(pose);
  DirectDrawing plain(scene.plain), untextured(scene.untextured);
  // Each does more than the one before: a step is the difference.
  constexpr size_t modes = 5;
  std::vector<BoundFragments> counted;
  std::vector<std::function<double()>> runs;
  for (size_t i = 0; i < frames.size(); ++i) {
    const auto& passes = frames[i].passes;
    counted.push_back(plain.bound_fragments(passes));
    runs.push_back([&] { return plain.draw(passes, {.output = Output::depth, .rasterizes = false}); });
    runs.push_back([&] { return plain.draw(passes, {.output = Output::depth}); });
    runs.push_back([&] { return untextured.draw(passes, {}); });
    runs.push_back([&] { return plain.draw(passes, {}); });
    runs.push_back([&] { return plain.draw(passes, {}, true); });
  }
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);
  const std::string title = fmt::format("{}, {} triangles", scene_name, scene.plain.triangle_count());
  fmt::print("\n{}\n\n", title);
  fmt::print(
      "| frame | touched K | kept K | overdraw | geometry ms | rays, depth | lighting | texturing | shadows | total ms "
      "(10–90%) | × planar |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (size_t i = 0; i < frames.size(); ++i) {
    const Timing* t = &timings[modes * i];
    const auto touched = double(counted[i].touched), kept = double(counted[i].kept);
    const double overdraw = kept > 0.0 ? touched / kept - 1.0 : 0.0;
    const Timing& total = t[modes - 1];
    const double ratio = ratio_of(total, timings[modes - 1]);
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f}% | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {} | {:.2f} |\n",
               frames[i].label, touched * 1e-3, kept * 1e-3, 100.0 * overdraw, t[0].median, t[1].median - t[0].median,
               t[2].median - t[1].median, t[3].median - t[2].median, t[4].median - t[3].median, to_text(total), ratio);
    nlohmann::json row = to_json(total);
    row["table"] = title;
    row["frame"] = frames[i].label;
    row["fragments_touched"] = touched;
    row["fragments_kept"] = kept;
    row["overdraw"] = overdraw;
    row["up_to_ms"] = {t[0].median, t[1].median, t[2].median, t[3].median, t[4].median};
    row["times_planar"] = ratio;
    rows.push_back(row);
  }
}

std::vector<Frame> step_frames(const glm::dmat4& pose, bool every_lens) {
  constexpr int side = 512;
  struct Named {
    const char* label;
    const char* lens;
  };
  constexpr Named lenses[] = {{"P, paraboloid", "stereographic:fov_deg=180"},
                              {"S, sphere", "orthographic_fisheye:fov_deg=180"},
                              {"lens 1", "equisolid:fov_deg=180"},
                              {"lens 2", "equidistant:fov_deg=180"}};
  std::vector<Frame> frames{
      {"GL, planar", {{make_camera("perspective:fov_deg=90", ImageSize{side, side}), pose, "planar"}}}};
  for (const Named& lens : lenses) {
    if (!every_lens && &lens != lenses) continue;
    for (const char* variant : variants) {
      frames.push_back(curved(lens.label, lens.lens, std::string("nonlinear:") + variant, pose, side));
    }
  }
  return frames;
}

/// Colour alone, for the cube map draws nothing else.
void run_against_cube_map(nlohmann::json& rows, const Options& options, const std::string& scene_name) {
  const Scene scene = load_scene(scene_name);
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  DirectDrawing drawing(scene);
  std::vector<Frame> frames;
  for (const char* technique : {"image-based:seen", "nonlinear:triangle", "nonlinear:quad", "nonlinear:hybrid"}) {
    frames.push_back(curved("paraboloid", "stereographic:fov_deg=180", technique, pose, 512));
  }
  frames.push_back({"planar, 90°", {{make_camera("perspective:fov_deg=90", ImageSize{512, 512}), pose, "planar"}}});
  std::vector<std::function<double()>> runs;
  for (const Frame& frame : frames) runs.push_back([&] { return drawing.draw(frame.passes, {}); });
  const std::vector<Timing> timings = measure_in_turn(runs, options.runs);
  const std::string title = fmt::format("{}, {} triangles, 512², colour", scene_name, scene.triangle_count());
  fmt::print("\n{}\n\n| frame | ms (10–90%) | × image-based | × planar |\n|---|---|---|---|\n", title);
  for (size_t i = 0; i < frames.size(); ++i) {
    fmt::print("| {} | {} | {:.2f} | {:.2f} |\n", frames[i].label, to_text(timings[i]),
               ratio_of(timings[i], timings[0]), ratio_of(timings[i], timings.back()));
    nlohmann::json row = to_json(timings[i]);
    row["table"] = title;
    row["frame"] = frames[i].label;
    row["times_image_based"] = ratio_of(timings[i], timings[0]);
    row["times_planar"] = ratio_of(timings[i], timings.back());
    rows.push_back(row);
  }
}

}  // namespace

nlohmann::json run_nonlinear(const Options& options) {
  nlohmann::json rows = nlohmann::json::array();
  run_table_2(rows, options);
  run_steps(rows, options, "facade:detail=1", [](const glm::dmat4& pose) { return step_frames(pose, true); });
  for (const char* scene : {"facade:detail=0", "facade:detail=2", "temple", "city"}) {
    run_steps(rows, options, scene, [](const glm::dmat4& pose) { return step_frames(pose, false); });
  }
  for (const char* scene : {"facade:detail=1", "city"}) run_against_cube_map(rows, options, scene);
  return rows;
}

}  // namespace omma::bench
