#include "omma/software/software_renderer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "omma/base/error.h"
#include "omma/camera/sampling_pattern.h"
#include "omma/software/channel_writer.h"
#include "omma/software/color_rows.h"
#include "omma/software/shade_fragments.h"

namespace omma {
namespace {

/// More samples come in passes: a square of pixels and what its rays meet should stay in the processor's caches.
constexpr size_t most_samples = 16;

class Stopwatch {
 public:
  explicit Stopwatch(SoftwareStats& stats) : stats_(stats) {}
  /// What has passed since the last call was `stage`'s.
  void add_to(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    const auto found = std::find_if(stats_.stage_ms.begin(), stats_.stage_ms.end(),
                                    [&](const auto& entry) { return entry.first == stage; });
    if (found == stats_.stage_ms.end()) {
      stats_.stage_ms.emplace_back(stage, ms);
    } else {
      found->second += ms;
    }
  }

 private:
  SoftwareStats& stats_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::vector<SeenInstance> seen_instances(const Scene& scene, const glm::dmat4& cameraFromWorld) {
  std::vector<SeenInstance> instances;
  instances.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) instances.emplace_back(scene, instance, cameraFromWorld);
  return instances;
}

}  // namespace

void SoftwareRenderer::update(const SceneChanges& changes) {
  if (changes.textures) textures_.clear();
  if (changes.of_shape() || changes.lights || changes.materials) {
    shadow_depths_.clear();
    surroundings_.clear();
  }
}

std::shared_ptr<const SoftwareRenderer::Textures> SoftwareRenderer::textures() const {
  return textures_.get(scene_->textures.size(), [&](size_t count) {
    std::vector<std::optional<MipTexture>> made(count);
    tbb::parallel_for(size_t{0}, count, [&](size_t i) { made[i].emplace(scene_->textures[i]); });
    Textures textures;
    textures.reserve(count);
    for (std::optional<MipTexture>& texture : made) textures.push_back(std::move(*texture));
    return std::make_shared<const Textures>(std::move(textures));
  });
}

std::shared_ptr<const ShadowDepths> SoftwareRenderer::shadow_depths(const ShadowKey& key) const {
  return shadow_depths_.get(key, [&](const ShadowKey& of) {
    return std::make_shared<const ShadowDepths>(index_->get(), of.kind, of.size, rays_);
  });
}

void SoftwareRenderer::draw_color(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  const SoftwareOptions& options, std::optional<int> hidden_object, const ColorRows& to,
                                  SoftwareStats& stats, const ChannelWriter* channels) const {
  Stopwatch watch(stats);
  const std::shared_ptr<const Textures> of_scene = textures();
  const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
  ShadedScene shaded{.scene = scene_, .worldFromCamera = worldFromCamera, .lights = {}, .textures = *of_scene};
  shaded.background = options.background;
  shaded.anisotropic = options.anisotropic;
  shaded.effects = options.effects;
  for (const Light& light : lights_of(*scene_)) shaded.lights.push_back(light_record(light, cameraFromWorld));
  std::vector<RecordInstance> instances;
  for (const SeenInstance& seen : seen_instances(*scene_, cameraFromWorld)) {
    instances.emplace_back(seen, glm::dmat3(cameraFromWorld), seen.object == options.reflect);
  }
  watch.add_to("prepare");
  std::shared_ptr<const ShadowDepths> shadows;
  if (options.shadows != Shadows::off) {
    shadows = shadow_depths({options.shadows, options.shadow_size});
    shaded.shadow_maps = shadow_map_records(shadows->layers(), worldFromCamera, ShadowDepths::near, shaded.lights);
    shaded.shadow_depths = shadows->depths().data();
    shaded.shadow_size = options.shadow_size;
    watch.add_to("shadow maps");
  }
  std::shared_ptr<const Surroundings> surroundings;
  if (options.reflect) {
    surroundings = surroundings_of(options);
    shaded.surroundings = surroundings.get();
    watch.add_to("reflection maps");
  }
  const Finder finder(index_->get(), worldFromCamera, hidden_object);
  watch.add_to("place");

  tbb::enumerable_thread_specific<Fragments> scratch([&] { return Fragments(instances); });
  const std::vector<glm::dvec2> pattern = sampling_pattern(options.samples);
  const size_t samples = pattern.size();
  for (size_t first = 0; first < samples; first += most_samples, ++stats.passes) {
    const size_t count = std::min(most_samples, samples - first);
    const float share = float(count) / float(samples);
    const std::shared_ptr<const RaySource> rays =
        rays_.of(camera, {pattern.begin() + ptrdiff_t(first), pattern.begin() + ptrdiff_t(first + count)});
    watch.add_to("rays");
    finder.each_square(*rays, [&](std::span<const FoundBlock> found) {
      if (options.stop.stop_requested()) throw Cancelled();
      Fragments& fragments = scratch.local();
      fragments.collect(found);
      const RayBlock& block = *found.front().block;
      shade_fragments(shaded, block, *found.front().border, fragments);
      fragments.resolve(share, first == 0, to, {block.pixel_x, block.pixel_y});
      if (channels != nullptr) channels->write(block, found.front().picture);
    });
    watch.add_to("find and shade");
  }
  for (const Fragments& fragments : scratch) stats.fragments += fragments.surfaces();
}

std::shared_ptr<const Surroundings> SoftwareRenderer::surroundings_of(const SoftwareOptions& options) const {
  const SurroundingsKey wanted{
      *options.reflect, options.reflection_size, options.background, {options.shadows, options.shadow_size}};
  return surroundings_.get(wanted, [&](const SurroundingsKey& key) {
    if (key.size > Surroundings::most_size) {
      throw MachineError("a reflection map of {} texels is too large; up to {} are possible", key.size,
                         Surroundings::most_size);
    }
    const ReflectionLayers layers = plan_reflection_layers(*scene_, key.object, key.size);
    const SoftwareOptions plain{.samples = 1,
                                .anisotropic = false,
                                .background = key.background,
                                .shadows = key.shadows.kind,
                                .shadow_size = key.shadows.size};
    std::array<FloatImage, 2> maps;
    for (size_t side = 0; side < maps.size(); ++side) {
      SoftwareStats stats;
      Image map = FloatImage(layers.camera.size(), 3);
      draw_color(layers.camera, layers.worldFromMap[side], plain, key.object,
                 ColorRows(buffer_of(map), layers.camera.size()), stats);
      maps[side] = std::get<FloatImage>(std::move(map));
    }
    return std::make_shared<const Surroundings>(layers, maps);
  });
}

void SoftwareRenderer::draw_channels(const Camera& camera, const glm::dmat4& worldFromCamera,
                                     const ChannelWriter& writer, const std::stop_token& stop,
                                     SoftwareStats& stats) const {
  Stopwatch watch(stats);
  const Finder finder(index_->get(), worldFromCamera);
  watch.add_to("place");
  const std::shared_ptr<const RaySource> rays = rays_.of(camera, {glm::dvec2(0.0)});
  watch.add_to("rays");
  finder.each_block(*rays, Solid::labels, [&](const RayBlock& block, const BlockPicture& picture) {
    if (stop.stop_requested()) throw Cancelled();
    writer.write(block, picture);
  });
  watch.add_to("find");
}

void SoftwareRenderer::render(const Camera& camera, const glm::dmat4& worldFromCamera, std::span<const Output> outputs,
                              const SoftwareOptions& options, SoftwareStats* stats) const {
  if (outputs.empty()) throw CommandError("no channel is asked for");
  if (options.samples < 1) throw CommandError("{} samples per pixel; 1 or more make a picture", options.samples);
  check_effects(options.effects);
  const ImageSize size = camera.size();
  for (const Output& output : outputs) check(output, size);
  for (const Output& output : outputs) fill_with_nothing(output, size);
  SoftwareStats took;
  const std::vector<SeenInstance> instances = seen_instances(*scene_, glm::inverse(worldFromCamera));
  const ChannelWriter writer(instances, worldFromCamera, outputs, size);
  const auto color = std::ranges::find(outputs, Channel::color, &Output::channel);
  const bool has_color = color != outputs.end(), has_others = outputs.size() > (has_color ? 1u : 0u);
  // All else is sampled at the pixels' centres, where a single sample lies, too; blended surfaces are solid there.
  const bool at_once = has_color && has_others && options.samples == 1 && !index_->get().has_blending();
  if (has_color) {
    const ChannelWriter* others = at_once ? &writer : nullptr;
    if (const ColorRows rows(color->to, size); rows.adds_up() || options.samples <= int(most_samples)) {
      draw_color(camera, worldFromCamera, options, std::nullopt, rows, took, others);
    } else {
      Image sum = FloatImage(size, 3);
      draw_color(camera, worldFromCamera, options, std::nullopt, ColorRows(buffer_of(sum), size), took, others);
      copy_image(sum, *color);
    }
  }
  if (has_others && !at_once) draw_channels(camera, worldFromCamera, writer, options.stop, took);
  took.bytes = bytes();
  if (stats != nullptr) *stats = took;
}

std::map<Channel, Image> SoftwareRenderer::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                                  std::span<const Channel> wanted, const SoftwareOptions& options,
                                                  SoftwareStats* stats) const {
  std::map<Channel, Image> images;
  std::vector<Output> outputs;
  for (const Channel channel : wanted) {
    const auto [image, is_new] = images.emplace(channel, make_image(channel, camera.size()));
    if (is_new) outputs.push_back({channel, buffer_of(image->second)});
  }
  render(camera, worldFromCamera, outputs, options, stats);
  return images;
}

size_t SoftwareRenderer::bytes() const {
  size_t sum = index_->bytes() + rays_.bytes();
  shadow_depths_.each([&](const ShadowDepths& maps) { sum += maps.depths().size() * sizeof(float); });
  textures_.each([&](const Textures& textures) {
    for (const MipTexture& texture : textures) sum += texture.bytes();
  });
  surroundings_.each([&](const Surroundings& maps) { sum += maps.bytes(); });
  return sum;
}

}  // namespace omma
