#include "bench/visibility_frames.h"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "bench/flat_embree.h"
#include "bench/frame.h"
#include "omma/camera/ray_bundle.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"

namespace omma::bench {
namespace {

constexpr ImageSize size{1600, 1200};
constexpr const char* lens = "equidistant:fov_deg=180";
constexpr const char* planar = "planar";
constexpr const char* techniques_drawn[] = {planar,    "image-based:passes", "image-based:layered", "image-based:seen",
                                            "raycast", "visibility:resolve", "visibility:cpu"};
/// They take seconds for what the others draw in a tenth: in the first case of each small scene alone.
constexpr const char* slow_techniques[] = {"nonlinear:hybrid", "piecewise:compute"};
constexpr const char* by_hand = "Embree, Lambert";

struct Case {
  std::string title;
  Filter filter = Filter::trilinear;
  bool textured = true;
  bool moving = false;  ///< every vertex, with every frame; an animated scene by its first animation
  bool slow = false;    ///< with the slow techniques
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// By its animation, or waves run over every mesh of the scene at rest.
void move(SceneEdit& scene, const Scene& rest, int frame) {
  if (!rest.animations.empty()) return scene.set_time(frame / 24.0);
  for (size_t m = 0; m < rest.meshes.size(); ++m) {
    std::vector<glm::vec3> positions = rest.meshes[m].positions;
    for (glm::vec3& p : positions) p.y += 0.05f * std::sin(p.x + 0.1f * float(frame));
    scene.set_vertices(int(m), positions);
  }
}

/// One of the ways to draw a frame, with what it needs and keeps.
struct Way {
  std::string name;
  Camera camera;
  std::function<double()> frame;  ///< milliseconds
  RenderStats stats{};
};

/// All ways to draw one scene. Where it moves, each has one prepared of its own: none pays for what others follow.
class Contest {
 public:
  Contest(Scene& scene, const Case& tested) : scene_(scene), tested_(tested) {
    options_.filter = tested.filter;
    options_.samples = 1;
    if (!tested.moving) prepare();
    std::vector<const char*> drawn(std::begin(techniques_drawn), std::end(techniques_drawn));
    if (tested.slow) drawn.insert(drawn.end(), std::begin(slow_techniques), std::end(slow_techniques));
    for (const char* technique : drawn) {
      if (tested.moving) prepare();
      add(technique, *prepared_.back());
    }
    add_embree();
  }

  nlohmann::json run(int runs);

 private:
  void prepare() { prepared_.push_back(std::make_unique<PreparedScene>(device_, scene_)); }

  void add(const std::string& technique, PreparedScene& prepared) {
    const char* camera = technique == planar ? "perspective:fov_deg=90" : lens;
    ways_.push_back(std::make_unique<Way>(Way{technique, make_camera(camera, size), {}}));
    Way& way = *ways_.back();
    way.frame = [this, &way, &prepared] {
      // Moving is not counted, following is: the first of the frame's stages.
      if (tested_.moving) prepared.edit([&](SceneEdit& scene) { move(scene, rest_, ++frame_); });
      RenderOptions options = options_;
      options.technique = way.name;
      constexpr Channel wanted[] = {Channel::color};
      prepared.render(way.camera, pose_, wanted, options, &way.stats);
      return frame_ms(way.stats);
    };
  }

  void add_embree() {
    ways_.push_back(std::make_unique<Way>(Way{by_hand, make_camera(lens, size), {}}));
    Way& way = *ways_.back();
    rays_ = rays_of(way.camera);
    colors_.resize(rays_.directions.size());
    embree_ = std::make_unique<FlatEmbree>(scene_, pose_, true);
    way.frame = [this, &way] {
      double build_ms = 0.0;
      auto begin = std::chrono::steady_clock::now();
      if (tested_.moving) {
        SceneChanges changes;
        SceneEdit edit(scene_, changes);
        move(edit, rest_, ++frame_);
        begin = std::chrono::steady_clock::now();
        embree_ = std::make_unique<FlatEmbree>(scene_, pose_, true);
        build_ms = milliseconds_since(begin);
        begin = std::chrono::steady_clock::now();
      }
      embree_->lambert(rays_.directions, rays_.size.width, colors_);
      way.stats.stage_ms = {{"build", build_ms}, {"trace and shade", milliseconds_since(begin)}};
      return frame_ms(way.stats);
    };
  }

  Scene& scene_;
  const Scene rest_ = scene_;
  Case tested_;
  glm::dmat4 pose_ = look_at_worldFromCamera(scene_.default_from, scene_.default_to);
  RenderOptions options_;
  const Device device_;
  std::vector<std::unique_ptr<PreparedScene>> prepared_;
  std::vector<std::unique_ptr<Way>> ways_;
  RayMap rays_;
  std::vector<glm::vec3> colors_;
  std::unique_ptr<FlatEmbree> embree_;
  int frame_ = 0;
};

nlohmann::json Contest::run(int runs) {
  std::vector<std::function<double()>> frames;
  for (const auto& way : ways_) frames.push_back(way->frame);
  const std::vector<std::vector<double>> times = times_in_turn(frames, runs);

  size_t planar_way = 0, best_images = 0, embree_way = 0;
  for (size_t i = 0; i < ways_.size(); ++i) {
    if (ways_[i]->name == planar) planar_way = i;
    if (ways_[i]->name == by_hand) embree_way = i;
    const bool images = ways_[i]->name.starts_with("image-based");
    const bool first = !ways_[best_images]->name.starts_with("image-based");
    if (images && (first || timing_of(times[i]).median < timing_of(times[best_images]).median)) best_images = i;
  }
  fmt::print("\n{}, {} triangles, {}{}\n\n", tested_.title, scene_.triangle_count(),
             tested_.textured ? filter_name(tested_.filter) : "without textures",
             tested_.moving ? scene_.animations.empty() ? "; all vertices move with every frame" : "; animated" : "");
  fmt::print(
      "| technique | ms (10–90%) | × best image-based | ns per pixel with a ray | × planar, per pixel | × Embree, "
      "Lambert | "
      "stages |\n|---|---|---|---|---|---|---|\n");
  nlohmann::json rows = nlohmann::json::array();
  const double planar_pixels = megapixels_seen(ways_[planar_way]->camera);
  for (size_t i = 0; i < ways_.size(); ++i) {
    const Way& way = *ways_[i];
    const Timing timing = timing_of(times[i]);
    const double pixels = megapixels_seen(way.camera);
    const Timing to_images = ratio_of(times[i], times[best_images]);
    const Timing to_planar = ratio_of(times[i], times[planar_way], planar_pixels / pixels);
    const Timing to_embree = ratio_of(times[i], times[embree_way]);
    fmt::print("| {} | {} | {} | {:.0f} | {} | {} | {} |\n", way.name, to_text(timing), ratio_text(to_images),
               timing.median / pixels, ratio_text(to_planar), ratio_text(to_embree), stages_text(way.stats));
    nlohmann::json row = to_json(timing);
    row["scene"] = tested_.title;
    row["triangles"] = scene_.triangle_count();
    row["filter"] = filter_name(tested_.filter);
    row["textured"] = tested_.textured;
    row["moving"] = tested_.moving;
    row["technique"] = way.name;
    row["times_best_image_based"] = to_images.median;
    row["times_planar_per_pixel"] = to_planar.median;
    row["times_embree_lambert"] = to_embree.median;
    row["stage_ms"] = way.stats.stage_ms;
    rows.push_back(row);
  }
  std::fflush(stdout);
  return rows;
}

/// Base colours alone, as the shading written by hand has them.
void strip_textures(Scene& scene) {
  for (Material& material : scene.materials) {
    material.base_color_texture = material.normal_texture = -1;
    material.metallic_roughness_texture = material.emissive_texture = -1;
  }
}

/// Labels and depth, which need no shading.
nlohmann::json run_channels(const std::string& name, int runs) {
  const Scene scene = load_scene(name);
  const glm::dmat4 pose = look_at_worldFromCamera(scene.default_from, scene.default_to);
  const Camera camera = make_camera(lens, size);
  constexpr Channel wanted[] = {Channel::id, Channel::distance};
  constexpr const char* drawn[] = {"visibility:cpu", "raycast", "image-based:seen"};
  const PreparedScene prepared(Device(), scene);
  std::vector<std::string> names;
  std::vector<std::function<double()>> frames;
  for (const char* technique : drawn) {
    names.emplace_back(technique);
    frames.emplace_back([&, technique] {
      RenderStats took;
      prepared.render(camera, pose, wanted, {.technique = technique}, &took);
      return frame_ms(took);
    });
  }
  const std::vector<std::vector<double>> times = times_in_turn(frames, runs);
  nlohmann::json rows = nlohmann::json::array();
  for (size_t i = 0; i < times.size(); ++i) {
    const Timing timing = timing_of(times[i]), ratio = ratio_of(times[0], times[i]);
    fmt::print("| {} | {} | {} | {} | {} |\n", name, scene.triangle_count(), names[i], to_text(timing),
               ratio_text(ratio));
    nlohmann::json row = to_json(timing);
    row["scene"] = name;
    row["technique"] = names[i];
    rows.push_back(row);
  }
  std::fflush(stdout);
  return rows;
}

}  // namespace

nlohmann::json run_visibility_frames(const Options& options) {
  // Frames of the others take long.
  const int runs = std::max(1, options.runs / 2);
  std::vector<std::pair<std::string, Case>> cases{
      {"city", {.title = "city", .slow = true}},
      {"city", {.title = "city", .filter = Filter::anisotropic}},
      {"city", {.title = "city", .textured = false}},
      {"city:blocks=16", {.title = "city:blocks=16"}},
      {"terrain:triangles=50000", {.title = "terrain:triangles=50000", .slow = true}},
      {"terrain:triangles=500000", {.title = "terrain:triangles=500000"}},
      {"terrain:triangles=2000000", {.title = "terrain:triangles=2000000"}},
      {"terrain:triangles=50000", {.title = "terrain:triangles=50000", .moving = true}},
  };
  if (!options.scene.empty()) {
    const std::string title = options.scene.substr(options.scene.rfind('/') + 1);
    cases.push_back({options.scene, {.title = title, .slow = true}});
    cases.push_back({options.scene, {.title = title, .filter = Filter::anisotropic}});
    if (!load_scene(options.scene).animations.empty()) {
      cases.push_back({options.scene, {.title = title, .moving = true}});
    }
  }
  fmt::print("\nWhole frames, {} x {}, one sample per pixel, `{}`; planar is `perspective:fov_deg=90`. Runs: {}.\n",
             size.width, size.height, lens, runs);
  nlohmann::json rows = nlohmann::json::array();
  for (const auto& [name, tested] : cases) {
    Scene scene = load_scene(name);
    if (!tested.textured) strip_textures(scene);
    for (nlohmann::json& row : Contest(scene, tested).run(runs)) rows.push_back(std::move(row));
  }
  fmt::print("\nIds and distances, {} x {}, `{}`.\n\n", size.width, size.height, lens);
  fmt::print("| scene | triangles | technique | ms (10–90%) | of it visibility takes |\n|---|---|---|---|---|\n");
  for (const char* name : {"city", "city:blocks=16"}) {
    for (nlohmann::json& row : run_channels(name, runs)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace omma::bench
