#include "omma/technique/renderer.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "omma/base/error.h"
#include "omma/technique/gpu_renderer.h"
#include "omma/technique/registry.h"
#include "omma/visibility/channel_renderer.h"
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

struct Renderer::Parts {
  const Scene* scene = nullptr;
  /// Each made when the first picture needs it.
  std::unique_ptr<GpuRenderer> gpu;
  bool gpu_has_scene = false;
  std::unique_ptr<ChannelRenderer> channels;

  const Scene& need_scene(const char* what) const {
    if (scene == nullptr) throw CommandError("there is no scene to {}; call Renderer::load first", what);
    return *scene;
  }
  void open_gl();
  std::map<Channel, Image> render_without_gl(const Camera& camera, const glm::dmat4& worldFromCamera,
                                             std::span<const Channel> wanted, const RenderOptions& options,
                                             RenderStats& stats);
};

void Renderer::Parts::open_gl() {
  if (gpu == nullptr) gpu = std::make_unique<GpuRenderer>();
  if (scene != nullptr && !gpu_has_scene) {
    gpu->load(*scene);
    gpu_has_scene = true;
  }
}

std::map<Channel, Image> Renderer::Parts::render_without_gl(const Camera& camera, const glm::dmat4& worldFromCamera,
                                                            std::span<const Channel> wanted,
                                                            const RenderOptions& options, RenderStats& stats) {
  if (channels == nullptr) stats.setup_ms = milliseconds([&] { channels = std::make_unique<ChannelRenderer>(*scene); });
  ChannelStats took;
  auto pictures = channels->render(camera, worldFromCamera, wanted, options.tile, &took);
  stats.renderer =
      fmt::format("the processor ({}, {} threads)", simd_targets().front(), std::thread::hardware_concurrency());
  stats.buffer_bytes = took.bytes;
  stats.tiles = took.tiles;
  stats.stage_ms = {{"ray tree", took.rays_ms}, {"find", took.find_ms}};
  return pictures;
}

Renderer::Renderer() : parts_(std::make_unique<Parts>()) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::open_gl() { parts_->open_gl(); }

void Renderer::load(const Scene& scene) {
  parts_->scene = &scene;
  parts_->channels.reset();
  parts_->gpu_has_scene = false;
  if (parts_->gpu != nullptr) parts_->open_gl();
}

void Renderer::update() {
  parts_->need_scene("update");
  if (parts_->gpu_has_scene) parts_->gpu->update();
  if (parts_->channels != nullptr) parts_->channels->update();
}

std::map<Channel, Image> Renderer::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                          std::span<const Channel> wanted, const RenderOptions& options,
                                          RenderStats* stats) {
  const Scene& scene = parts_->need_scene("render");
  check(wanted, options);
  const bool shaded = std::any_of(wanted.begin(), wanted.end(), is_shaded);
  const ChosenTechnique chosen = choose_technique(options.technique, camera, shaded);
  check_show(options.show, chosen);
  effects_of(options);
  RenderStats took;
  took.technique = chosen.name();
  took.triangles = scene.triangle_count();
  std::map<Channel, Image> pictures;
  if (!shaded && chosen.draws_without_gl()) {
    pictures = parts_->render_without_gl(camera, worldFromCamera, wanted, options, took);
  } else {
    took.setup_ms = milliseconds([&] {
      try {
        parts_->open_gl();
      } catch (const MachineError& error) {
        throw MachineError("{}\n{}", error.what(), what_works_without_gl());
      }
    });
    pictures = parts_->gpu->render(camera, worldFromCamera, wanted, options, chosen, took);
  }
  if (stats != nullptr) *stats = std::move(took);
  return pictures;
}

}  // namespace omma
