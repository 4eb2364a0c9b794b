#include "omma/render/prepared_scene.h"

#include <algorithm>
#include <chrono>
#include <shared_mutex>
#include <thread>

#include "omma/base/error.h"
#include "omma/render/device_parts.h"
#include "omma/render/gpu_renderer.h"
#include "omma/software/software_renderer.h"
#include "omma/technique/registry.h"
#include "omma/visibility/find_blocks.h"

namespace omma {
namespace {

constexpr int max_samples = 1024;

/// Throws CommandError for what no technique could draw.
void check(std::span<const Channel> wanted, const RenderOptions& options) {
  if (wanted.empty()) throw CommandError("no channel is asked for");
  if (options.samples < 1 || options.samples > max_samples) {
    throw CommandError("{} samples per pixel; 1 to {} are possible", options.samples, max_samples);
  }
  if (options.tile < 0 || options.face_size < 0) throw CommandError("a tile or face size cannot be negative");
  if (std::min(options.shadow_size, options.reflection_size) < 16) {
    throw CommandError("a shadow or reflection map of {} texels; 16 or more make one",
                       std::min(options.shadow_size, options.reflection_size));
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
  void draw_without_gl(const Camera& camera, const glm::dmat4& worldFromCamera, std::span<const Channel> wanted,
                       const RenderOptions& options, std::map<Channel, Image>& pictures, RenderStats& stats);
  void draw_by_gl(const Camera& camera, const glm::dmat4& worldFromCamera, std::span<const Channel> wanted,
                  const RenderOptions& options, const ChosenTechnique& chosen, std::map<Channel, Image>& pictures,
                  RenderStats& stats);
};

PreparedScene::Parts::~Parts() {
  if (gpu == nullptr) return;
  const std::lock_guard lock(device->mutex);
  try {
    const gl::Current current(device->gl->context);
    gpu.reset();
  } catch (const MachineError&) {
    // Current on another thread: what is left goes with it.
    gpu.release();
  }
}

std::shared_lock<std::shared_mutex> PreparedScene::Parts::settle(RenderStats& stats) {
  for (;;) {
    std::shared_lock shared(mutex);
    if (changes.empty()) return shared;
    shared.unlock();
    isolated([&] {
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

void PreparedScene::Parts::draw_without_gl(const Camera& camera, const glm::dmat4& worldFromCamera,
                                           std::span<const Channel> wanted, const RenderOptions& options,
                                           std::map<Channel, Image>& pictures, RenderStats& stats) {
  stats.setup_ms += milliseconds([&] { index.get(); });
  SoftwareStats took;
  const SoftwareOptions how{.samples = options.samples,
                            .anisotropic = options.filter == Filter::anisotropic,
                            .background = options.background,
                            .effects = effects_of(options),
                            .shadows = options.shadows,
                            .shadow_size = options.shadow_size,
                            .reflect = options.reflect,
                            .reflection_size = options.reflection_size};
  pictures = software.render(camera, worldFromCamera, wanted, how, &took);
  stats.renderer =
      fmt::format("the processor ({}, {} threads)", simd_targets().front(), std::thread::hardware_concurrency());
  stats.buffer_bytes = took.bytes;
  stats.tiles = 1;
  stats.passes = took.passes;
  stats.samples_kept = took.fragments;
  if (took.passes > 0) stats.fragments_shaded = took.fragments;
  stats.stage_ms.insert(stats.stage_ms.end(), took.stage_ms.begin(), took.stage_ms.end());
}

void PreparedScene::Parts::draw_by_gl(const Camera& camera, const glm::dmat4& worldFromCamera,
                                      std::span<const Channel> wanted, const RenderOptions& options,
                                      const ChosenTechnique& chosen, std::map<Channel, Image>& pictures,
                                      RenderStats& stats) {
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
  pictures.merge(renderer->render(camera, worldFromCamera, wanted, options, chosen, stats));
  stats.stage_ms.insert(stats.stage_ms.begin(), others.begin(), others.end());
}

PreparedScene::PreparedScene(const Device& device, Scene scene)
    : parts_(std::make_unique<Parts>(device.parts(), std::move(scene))) {}
PreparedScene::~PreparedScene() = default;
PreparedScene::PreparedScene(PreparedScene&&) noexcept = default;
PreparedScene& PreparedScene::operator=(PreparedScene&&) noexcept = default;

const Scene& PreparedScene::scene() const { return parts_->scene; }

void PreparedScene::edit(const std::function<void(SceneEdit&)>& change) {
  const std::unique_lock alone(parts_->mutex);
  SceneEdit edit(parts_->scene, parts_->changes);
  change(edit);
}

std::map<Channel, Image> PreparedScene::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                               std::span<const Channel> wanted, const RenderOptions& options,
                                               RenderStats* stats) const {
  check(wanted, options);
  RenderStats took;
  Occasion occasion;
  occasion.shaded = std::find(wanted.begin(), wanted.end(), Channel::color) != wanted.end();
  occasion.plain = !options.show.contains(Show::pieces) && !options.show.contains(Show::overdraw);
  if (options.technique == "auto" && occasion.shaded && occasion.plain) {
    took.setup_ms += milliseconds([&] {
      const std::lock_guard lock(parts_->device->mutex);
      const gl::Current before;
      occasion.gpu = parts_->device->has_gpu();
    });
  }
  const ChosenTechnique chosen = choose_technique(options.technique, camera, occasion);
  check_show(options.show, chosen);
  const auto shared = parts_->settle(took);
  took.triangles = parts_->scene.triangle_count();
  took.technique = chosen.name();
  std::vector<Channel> by_gl, without_gl;
  for (const Channel channel : wanted) {
    const bool needs_gl = !chosen.draws_without_gl() || (channel == Channel::color && !occasion.plain);
    (needs_gl ? by_gl : without_gl).push_back(channel);
  }
  std::map<Channel, Image> pictures;
  if (!without_gl.empty()) {
    parts_->draw_without_gl(camera, worldFromCamera, without_gl, options, pictures, took);
  }
  if (!by_gl.empty()) {
    parts_->draw_by_gl(camera, worldFromCamera, by_gl, options, with_gl(chosen), pictures, took);
  }
  if (stats != nullptr) *stats = std::move(took);
  return pictures;
}

}  // namespace omma
