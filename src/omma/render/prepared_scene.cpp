#include "omma/render/prepared_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <shared_mutex>
#include <thread>

#include "omma/base/error.h"
#include "omma/base/isolated.h"
#include "omma/render/device_parts.h"
#include "omma/render/gpu_renderer.h"
#include "omma/software/software_renderer.h"
#include "omma/technique/registry.h"
#include "omma/visibility/find_blocks.h"

namespace omma {
namespace {

constexpr int max_samples = 1024;

/// Throws CommandError for what no technique could draw.
void check(const RenderOptions& options) {
  if (options.samples < 1 || options.samples > max_samples) {
    throw CommandError("{} samples per pixel; 1 to {} are possible", options.samples, max_samples);
  }
  if (options.tile < 0 || options.face_size < 0) throw CommandError("a tile or face size cannot be negative");
  if (std::min(options.shadow_size, options.reflection_size) < 16) {
    throw CommandError("a shadow or reflection map of {} texels; 16 or more make one",
                       std::min(options.shadow_size, options.reflection_size));
  }
}

/// What is shown over the picture needs OpenGL.
bool is_plain(const RenderOptions& options) {
  return !options.show.contains(Show::pieces) && !options.show.contains(Show::overdraw);
}

void check(const Shot& shot) {
  if (shot.outputs.empty()) throw CommandError("no channel is asked for");
  std::set<Channel> channels;
  for (const Output& output : shot.outputs) {
    check(output, shot.camera.size());
    if (!channels.insert(output.channel).second) {
      throw CommandError("channel '{}' has two outputs", channel_info(output.channel).name);
    }
  }
}

template <typename Work>
double milliseconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

struct PreparedScene::Parts {
  Parts(std::shared_ptr<Device::Parts> of_device, Scene of_caller)
      : device(std::move(of_device)), scene(std::move(of_caller)), index(scene), software(index) {}
  ~Parts();

  std::shared_ptr<Device::Parts> device;
  std::mutex turnstile;     ///< whoever waits for the next one goes before all who come later
  std::shared_mutex mutex;  ///< pictures share it, changes have it alone
  Scene scene;
  SceneChanges changes;  ///< that nothing has followed yet
  LazySceneIndex index;
  SoftwareRenderer software;
  std::unique_ptr<GpuRenderer> gpu;  ///< with the device's mutex
  SceneChanges changes_for_gpu;

  /// Holds pictures back no longer than it takes to follow the last changes.
  std::shared_lock<std::shared_mutex> settle(RenderStats& stats);
  /// With the device's mutex, and its context current.
  GpuRenderer& on_gpu(RenderStats& stats);
  /// How a shot is drawn, which is in order.
  ChosenTechnique choose(const Shot& shot, const RenderOptions& options, RenderStats& stats) const;
  void draw(const Shot& shot, const RenderOptions& options, const ChosenTechnique& chosen, RenderStats& stats);
  void draw_without_gl(const Shot& shot, std::span<const Output> outputs, const RenderOptions& options,
                       RenderStats& stats);
  void draw_by_gl(const Shot& shot, std::span<const Output> outputs, const RenderOptions& options,
                  const ChosenTechnique& chosen, RenderStats& stats);
};

PreparedScene::Parts::~Parts() {
  if (gpu == nullptr) return;
  const std::lock_guard lock(device->mutex);
  try {
    const gl::Current current(device->gl->context);
    gpu.reset();
  } catch (const MachineError&) {
    // Current on another thread: what is left goes with it.
    (void)gpu.release();
  }
}

std::shared_lock<std::shared_mutex> PreparedScene::Parts::settle(RenderStats& stats) {
  for (;;) {
    std::unique_lock turn(turnstile);
    std::shared_lock shared(mutex);
    turn.unlock();
    if (changes.empty()) return shared;
    shared.unlock();
    isolated([&] {
      const std::lock_guard next(turnstile);
      const std::unique_lock alone(mutex);
      if (changes.empty()) return;  // another thread was here before
      const double ms = milliseconds([&] {
        index.update(changes);
        software.update(changes);
      });
      stats.stage_ms.emplace_back("follow", ms);
      if (gpu != nullptr) changes_for_gpu += changes;
      changes = {};
    });
  }
}

GpuRenderer& PreparedScene::Parts::on_gpu(RenderStats& stats) {
  if (gpu == nullptr) {
    gpu = std::make_unique<GpuRenderer>(device->open(), index);
  } else if (!changes_for_gpu.empty()) {
    const double ms = milliseconds([&] { gpu->update(changes_for_gpu); });
    stats.stage_ms.emplace_back("follow on the GPU", ms);
  }
  changes_for_gpu = {};
  return *gpu;
}

void PreparedScene::Parts::draw_without_gl(const Shot& shot, std::span<const Output> outputs,
                                           const RenderOptions& options, RenderStats& stats) {
  stats.setup_ms += milliseconds([&] { index.get(); });
  SoftwareStats took;
  const SoftwareOptions how{.samples = options.samples,
                            .anisotropic = options.filter == Filter::anisotropic,
                            .background = options.background,
                            .effects = effects_of(options),
                            .shadows = options.shadows,
                            .shadow_size = options.shadow_size,
                            .reflect = options.reflect,
                            .reflection_size = options.reflection_size,
                            .stop = options.stop};
  software.render(shot.camera, shot.worldFromCamera, outputs, how, &took);
  stats.renderer =
      fmt::format("the processor ({}, {} threads)", simd_targets().front(), std::thread::hardware_concurrency());
  stats.buffer_bytes = took.bytes;
  stats.tiles = 1;
  stats.passes = took.passes;
  stats.samples_kept = took.fragments;
  if (took.passes > 0) stats.fragments_shaded = took.fragments;
  stats.stage_ms.insert(stats.stage_ms.end(), took.stage_ms.begin(), took.stage_ms.end());
}

void PreparedScene::Parts::draw_by_gl(const Shot& shot, std::span<const Output> outputs, const RenderOptions& options,
                                      const ChosenTechnique& chosen, RenderStats& stats) {
  const std::lock_guard lock(device->mutex);
  const gl::Current before;
  GpuRenderer* renderer = nullptr;
  stats.setup_ms += milliseconds([&] {
    try {
      device->open().context.make_current();
      renderer = &on_gpu(stats);
    } catch (const MachineError& error) {
      throw MachineError("{}\n{}", error.what(), what_works_without_gl());
    }
  });
  stats.technique = chosen.name();
  const auto others = std::move(stats.stage_ms);
  std::vector<Channel> wanted;
  for (const Output& output : outputs) wanted.push_back(output.channel);
  const auto pictures = renderer->render(shot.camera, shot.worldFromCamera, wanted, options, chosen, stats);
  for (const Output& output : outputs) copy_image(pictures.at(output.channel), output);
  stats.stage_ms.insert(stats.stage_ms.begin(), others.begin(), others.end());
}

PreparedScene::PreparedScene(const Device& device, Scene scene)
    : parts_(std::make_unique<Parts>(device.parts(), std::move(scene))) {}
PreparedScene::~PreparedScene() = default;
PreparedScene::PreparedScene(PreparedScene&&) noexcept = default;
PreparedScene& PreparedScene::operator=(PreparedScene&&) noexcept = default;

const Scene& PreparedScene::scene() const { return parts_->scene; }

void PreparedScene::edit(const std::function<void(SceneEdit&)>& change) {
  isolated([&] {
    const std::lock_guard next(parts_->turnstile);
    const std::unique_lock alone(parts_->mutex);
    SceneEdit edit(parts_->scene, parts_->changes);
    change(edit);
  });
}

ChosenTechnique PreparedScene::Parts::choose(const Shot& shot, const RenderOptions& options, RenderStats& stats) const {
  Occasion occasion;
  occasion.shaded = std::ranges::find(shot.outputs, Channel::color, &Output::channel) != shot.outputs.end();
  occasion.plain = is_plain(options);
  if (options.technique == "auto" && occasion.shaded && occasion.plain) {
    stats.setup_ms += milliseconds([&] {
      const std::lock_guard lock(device->mutex);
      const gl::Current before;
      occasion.gpu = device->has_gpu();
    });
  }
  ChosenTechnique chosen = choose_technique(options.technique, shot.camera, occasion);
  check_show(options.show, chosen);
  return chosen;
}

void PreparedScene::Parts::draw(const Shot& shot, const RenderOptions& options, const ChosenTechnique& chosen,
                                RenderStats& stats) {
  stats.triangles = scene.triangle_count();
  stats.technique = chosen.name();
  std::vector<Output> by_gl, without_gl;
  for (const Output& output : shot.outputs) {
    const bool needs_gl = !chosen.draws_without_gl() || (output.channel == Channel::color && !is_plain(options));
    (needs_gl ? by_gl : without_gl).push_back(output);
  }
  if (!without_gl.empty()) draw_without_gl(shot, without_gl, options, stats);
  if (!by_gl.empty()) draw_by_gl(shot, by_gl, options, with_gl(chosen), stats);
}

void PreparedScene::render(std::span<const Shot> shots, const RenderOptions& options,
                           std::vector<RenderStats>* stats) const {
  check(options);
  for (const Shot& shot : shots) check(shot);
  std::vector<RenderStats> took(shots.size());
  std::vector<ChosenTechnique> chosen;
  for (size_t i = 0; i < shots.size(); ++i) chosen.push_back(parts_->choose(shots[i], options, took[i]));
  if (!shots.empty()) {
    const auto shared = parts_->settle(took.front());
    // OpenGL has one context: there they take turns.
    const bool beside_each_other = std::ranges::all_of(chosen, &ChosenTechnique::draws_without_gl) && is_plain(options);
    const auto draw = [&](size_t i) { parts_->draw(shots[i], options, chosen[i], took[i]); };
    isolated([&] {  // the scene is locked
      if (beside_each_other) return tbb::parallel_for(size_t{0}, shots.size(), draw);
      for (size_t i = 0; i < shots.size(); ++i) draw(i);
    });
  }
  if (stats != nullptr) *stats = std::move(took);
}

void PreparedScene::render(const Shot& shot, const RenderOptions& options, RenderStats* stats) const {
  std::vector<RenderStats> took;
  render(std::span(&shot, 1), options, &took);
  if (stats != nullptr) *stats = std::move(took.front());
}

std::map<Channel, Image> PreparedScene::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                               std::span<const Channel> wanted, const RenderOptions& options,
                                               RenderStats* stats) const {
  std::map<Channel, Image> pictures;
  Shot shot{camera, worldFromCamera, {}};
  for (const Channel channel : wanted) {
    const auto [image, is_new] = pictures.emplace(channel, make_image(channel, camera.size()));
    if (is_new) shot.outputs.push_back({channel, buffer_of(image->second)});
  }
  render(shot, options, stats);
  return pictures;
}

}  // namespace omma
