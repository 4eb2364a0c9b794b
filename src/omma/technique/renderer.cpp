#include "omma/technique/renderer.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "omma/base/error.h"
#include "omma/gl/devices.h"
#include "omma/software/software_renderer.h"
#include "omma/technique/gpu_renderer.h"
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

struct Renderer::Parts {
  const Scene* scene = nullptr;
  /// Each made when the first picture needs it.
  std::unique_ptr<GpuRenderer> gpu;
  bool gpu_has_scene = false;
  std::optional<bool> gpu_at_hand;
  std::unique_ptr<SoftwareRenderer> software;

  const Scene& need_scene(const char* what) const {
    if (scene == nullptr) throw CommandError("there is no scene to {}; call Renderer::load first", what);
    return *scene;
  }
  void open_gl();
  /// Opens a context to see where EGL lists a GPU at all.
  bool has_gpu();
  std::map<Channel, Image> render_without_gl(const Camera& camera, const glm::dmat4& worldFromCamera,
                                             std::span<const Channel> wanted, const RenderOptions& options,
                                             RenderStats& stats);
};

bool Renderer::Parts::has_gpu() {
  if (!gpu_at_hand && gpu == nullptr && !gl::lists_hardware_device()) gpu_at_hand = false;
  if (!gpu_at_hand) {
    try {
      if (gpu == nullptr) gpu = std::make_unique<GpuRenderer>();
      gpu_at_hand = !gpu->is_software();
    } catch (const MachineError&) {
      gpu_at_hand = false;
    }
  }
  return *gpu_at_hand;
}

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
  if (software == nullptr) {
    stats.setup_ms += milliseconds([&] { software = std::make_unique<SoftwareRenderer>(*scene); });
  }
  SoftwareStats took;
  const SoftwareOptions how{.samples = options.samples,
                            .anisotropic = options.filter == Filter::anisotropic,
                            .background = options.background,
                            .effects = effects_of(options),
                            .shadows = options.shadows,
                            .shadow_size = options.shadow_size,
                            .reflect = options.reflect,
                            .reflection_size = options.reflection_size};
  auto pictures = software->render(camera, worldFromCamera, wanted, how, &took);
  stats.renderer =
      fmt::format("the processor ({}, {} threads)", simd_targets().front(), std::thread::hardware_concurrency());
  stats.buffer_bytes = took.bytes;
  stats.tiles = 1;
  stats.passes = took.passes;
  stats.samples_kept = took.fragments;
  if (took.passes > 0) stats.fragments_shaded = took.fragments;
  stats.stage_ms = std::move(took.stage_ms);
  return pictures;
}

Renderer::Renderer() : parts_(std::make_unique<Parts>()) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::open_gl() { parts_->open_gl(); }

void Renderer::load(const Scene& scene) {
  parts_->scene = &scene;
  parts_->software.reset();
  parts_->gpu_has_scene = false;
  if (parts_->gpu != nullptr) parts_->open_gl();
}

void Renderer::update() {
  parts_->need_scene("update");
  if (parts_->gpu_has_scene) parts_->gpu->update();
  if (parts_->software != nullptr) parts_->software->update();
}

std::map<Channel, Image> Renderer::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                          std::span<const Channel> wanted, const RenderOptions& options,
                                          RenderStats* stats) {
  const Scene& scene = parts_->need_scene("render");
  check(wanted, options);
  RenderStats took;
  Occasion occasion;
  occasion.shaded = std::find(wanted.begin(), wanted.end(), Channel::color) != wanted.end();
  occasion.plain = !options.show.contains(Show::pieces) && !options.show.contains(Show::overdraw);
  if (options.technique == "auto" && occasion.shaded && occasion.plain) {
    took.setup_ms += milliseconds([&] { occasion.gpu = parts_->has_gpu(); });
  }
  ChosenTechnique chosen = choose_technique(options.technique, camera, occasion);
  check_show(options.show, chosen);
  took.triangles = scene.triangle_count();
  took.technique = chosen.name();
  std::vector<Channel> by_gl, without_gl;
  for (const Channel channel : wanted) {
    const bool needs_gl = !chosen.draws_without_gl() || (channel == Channel::color && !occasion.plain);
    (needs_gl ? by_gl : without_gl).push_back(channel);
  }
  std::map<Channel, Image> pictures;
  if (!without_gl.empty()) {
    pictures = parts_->render_without_gl(camera, worldFromCamera, without_gl, options, took);
  }
  if (!by_gl.empty()) {
    took.setup_ms += milliseconds([&] {
      try {
        parts_->open_gl();
      } catch (const MachineError& error) {
        throw MachineError("{}\n{}", error.what(), what_works_without_gl());
      }
    });
    chosen = with_gl(chosen);
    took.technique = chosen.name();
    const auto before = std::move(took.stage_ms);
    pictures.merge(parts_->gpu->render(camera, worldFromCamera, by_gl, options, chosen, took));
    took.stage_ms.insert(took.stage_ms.begin(), before.begin(), before.end());
  }
  if (stats != nullptr) *stats = std::move(took);
  return pictures;
}

}  // namespace omma
