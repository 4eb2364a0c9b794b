#include "omma/render/gpu_renderer.h"

#include <algorithm>
#include <bit>

#include "omma/base/error.h"
#include "omma/camera/pieces/piece_set.h"
#include "omma/camera/sampling_pattern.h"
#include "omma/math/tiles.h"
#include "omma/technique/sample_places.h"

namespace omma {

/// The samples of a picture as passes: one with the driver's own samples where it has just as many, otherwise some with
/// a sample at each of several shifts.
struct GpuRenderer::Passes {
  Passes(int samples, int most_driver_samples, size_t shifts_at_once, SamplePlaces& places_of_driver);
  std::span<const glm::ivec2> sample_places = one_sample_place;  ///< in a pass
  std::vector<glm::dvec2> shifts;
  size_t at_once = 1;  ///< of the shifts, but in the last pass
  size_t count() const { return (shifts.size() + at_once - 1) / at_once; }
};

namespace {

/// A tile's images are many (samples, depth, channels); larger tiles gain nothing.
constexpr int preferred_tile = 4096;

void paste(const Image& tile, const PixelRect& place, Image& whole) {
  std::visit(
      [&](const auto& part) {
        auto& image = std::get<std::decay_t<decltype(part)>>(whole);
        for (int y = 0; y < part.size.height; ++y) {
          std::copy_n(part.at(0, y), size_t(part.size.width) * size_t(part.components),
                      image.at(place.x0, place.y0 + y));
        }
      },
      tile);
}

}  // namespace

GpuRenderer::Passes::Passes(int wanted, int most_driver_samples, size_t shifts_at_once,
                            SamplePlaces& places_of_driver) {
  // Drivers have powers of two. To shift their pattern for more samples than they have would sample neighbouring
  // pixels.
  if (wanted > 1 && wanted <= most_driver_samples && std::has_single_bit(unsigned(wanted))) {
    const std::span<const glm::ivec2> places = places_of_driver.of(wanted);
    if (places.size() == size_t(wanted)) {
      sample_places = places;
      // Not every driver's pattern has its middle in the pixel's.
      glm::dvec2 middle(0.0);
      for (const glm::ivec2& place : places) middle += glm::dvec2(place) / double(wanted);
      shifts.push_back(glm::round(0.5 * double(piece_grid) - middle) / double(piece_grid));
      return;
    }
  }
  shifts = sampling_pattern(wanted);
  at_once = std::min(shifts.size(), shifts_at_once);
}

GpuRenderer::GpuRenderer(GlDevice& device, const LazySceneIndex& index)
    : device_(device),
      gpu_scene_(index.scene(), device.context),
      tools_{device.context, gpu_scene_, index, device.programs},
      shadow_maps_(std::make_unique<ShadowMaps>(tools_, gpu_scene_)),
      reflection_maps_(std::make_unique<ReflectionMaps>(tools_, gpu_scene_)) {}

void GpuRenderer::update(const SceneChanges& changes) {
  gpu_scene_.update(changes);
  if (changes.listed || !changes.replaced.empty()) {
    // Techniques know the scene's parts by their numbers.
    techniques_.clear();
    gpu_scene_.set_shadows(nullptr);
    gpu_scene_.set_reflection(nullptr);
    shadow_maps_ = std::make_unique<ShadowMaps>(tools_, gpu_scene_);
    reflection_maps_ = std::make_unique<ReflectionMaps>(tools_, gpu_scene_);
    return;
  }
  if (changes.of_shape()) {
    for (auto& [name, technique] : techniques_) technique->scene_changed(changes);
  }
  shadow_maps_->scene_changed(changes);
  reflection_maps_->scene_changed(changes);
}

Technique& GpuRenderer::technique_for(const ChosenTechnique& chosen) {
  std::unique_ptr<Technique>& technique = techniques_[chosen.name()];
  if (!technique) technique = chosen.entry->make(tools_, chosen.variant);
  return *technique;
}

const Target& GpuRenderer::target_for(ImageSize size, std::span<const Channel> outputs) {
  if (!target_.fits(size, outputs, 1)) target_ = Target(size, outputs);
  return target_;
}

double GpuRenderer::timed(const std::function<void()>& draw) {
  tools_.timer.finish();
  draw();
  double sum = 0.0;
  for (const auto& [stage, ms] : tools_.timer.finish()) sum += ms;
  return sum;
}

Image GpuRenderer::draw_color(Technique& technique, View view, const Passes& passes, bool show_pieces,
                              const std::stop_token& stop) {
  static constexpr Channel outputs[] = {Channel::color};
  view.outputs = outputs;
  view.sample_places = passes.sample_places;
  const Target& picture = target_for(view.size(), outputs);
  const std::span<const glm::dvec2> shifts(passes.shifts);
  const auto draw_pass = [&](std::span<const glm::dvec2> of_pass) {
    if (stop.stop_requested()) throw Cancelled();
    if (of_pass.size() > 1) {
      view.shifts = of_pass;
    } else {
      view.shifts = {};
      view.shift = of_pass.front();
    }
    technique.draw(view, picture);
    if (show_pieces) draw_piece_borders(technique, view, picture);
  };
  if (passes.count() == 1) {
    draw_pass(shifts);
    tools_.timer.mark("read back");
    return read_back(picture.image(Channel::color), Channel::color, view.size());
  }
  // Half floats hold a pass, but not the sum of a thousand.
  const gl::Texture total = gl::Texture::image(GL_RGBA32F, view.size());
  const gl::Framebuffer framebuffer = gl::create_framebuffer();
  glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, total.id(), 0);
  const GLfloat zero[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, zero);
  const gl::Program& add = tools_.programs.get(
      {{GL_VERTEX_SHADER, "common/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "common/accumulate.frag"}}, {});
  for (size_t first = 0; first < shifts.size(); first += passes.at_once) {
    const auto of_pass = shifts.subspan(first, std::min(passes.at_once, shifts.size() - first));
    draw_pass(of_pass);
    tools_.timer.mark("accumulate");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glBindSampler(0, 0);
    picture.image(Channel::color).bind(0);
    add.set("weight", float(of_pass.size()) / float(shifts.size()));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    tools_.draw_fullscreen(add);
    glDisable(GL_BLEND);
  }
  tools_.timer.mark("read back");
  return read_back(total, Channel::color, view.size());
}

void GpuRenderer::draw_piece_borders(const Technique& technique, const View& view, const Target& picture) {
  const Camera* pieces = view.camera.pieces() != nullptr ? &view.camera : technique.pieces();
  if (pieces == nullptr) {
    throw CommandError("there are no pieces to show: technique piecewise draws them, or a camera in the pieces form");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
  glViewport(0, 0, view.size().width, view.size().height);
  tools_.draw_piece_borders(view, *pieces);
}

void GpuRenderer::draw_channels(Technique& technique, View view, std::map<Channel, Image>& pictures) {
  std::vector<Channel> outputs;
  for (const auto& [channel, image] : pictures) {
    if (channel != Channel::color) outputs.push_back(channel);
  }
  if (outputs.empty()) return;
  view.outputs = outputs;
  const Target& picture = target_for(view.size(), outputs);
  technique.draw(view, picture);
  tools_.timer.mark("read back");
  for (Channel channel : outputs) {
    paste(read_back(picture.image(channel), channel, view.size()), view.tile, pictures.at(channel));
  }
}

std::map<Channel, Image> GpuRenderer::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                             std::span<const Channel> wanted, const RenderOptions& options,
                                             const ChosenTechnique& chosen, RenderStats& stats) {
  const std::vector<Effect> effects = effects_of(options);
  const gl::Limits& limits = device_.context.limits();
  gpu_scene_.set_hidden(std::nullopt);  // whatever a picture that failed has left
  Technique& technique = technique_for(chosen);
  const double shadow_ms = timed([&] { shadow_maps_->use(options.shadows, options.shadow_size); });
  const double reflection_ms = timed([&] { reflection_maps_->use(options); });
  gpu_scene_.set_view(worldFromCamera, options.background);

  const int most = std::min(limits.texture_size, limits.viewport_size);
  const int side = options.tile > 0 ? std::min(options.tile, most) : std::min(most, preferred_tile);
  const std::vector<PixelRect> tiles = tiles_of(camera.size(), side);
  const ImageSize largest{std::min(side, camera.size().width), std::min(side, camera.size().height)};
  const Passes passes(options.samples, technique.multisamples() ? limits.samples : 1, technique.shifts_at_once(largest),
                      device_.sample_places);

  std::map<Channel, Image> pictures;
  for (Channel channel : wanted) pictures.emplace(channel, make_image(channel, camera.size()));
  tools_.counters.finish();
  BoundFragments bound_fragments;
  for (const PixelRect& tile : tiles) {
    if (options.stop.stop_requested()) throw Cancelled();
    View view{.camera = camera, .worldFromCamera = worldFromCamera, .tile = tile};
    view.filter = options.filter;
    view.face_size = options.face_size;
    view.pieces = options.pieces;
    view.show_overdraw = options.show.contains(Show::overdraw);
    view.bound_fragments = options.count_fragments && chosen.entry->info.bounds ? &bound_fragments : nullptr;
    if (pictures.contains(Channel::color)) {
      View shaded = view;
      shaded.effects = effects;
      paste(draw_color(technique, shaded, passes, options.show.contains(Show::pieces), options.stop), tile,
            pictures.at(Channel::color));
    }
    draw_channels(technique, view, pictures);
  }
  const gl::Counts counts = tools_.counters.finish();
  auto stages = tools_.timer.finish();
  stats.renderer = device_.context.renderer();
  stats.triangles_drawn = size_t(counts.primitives);
  stats.fragments_shaded = counts.fragments;
  stats.samples_kept = counts.samples;
  stats.buffer_bytes = gpu_scene_.bytes() + target_.bytes() + tools_.multisample_target.bytes() +
                       technique.buffer_bytes() + shadow_maps_->bytes() + reflection_maps_->bytes();
  stats.tiles = int(tiles.size());
  stats.passes = pictures.contains(Channel::color) ? int(passes.count()) : 0;
  stats.stage_ms = std::move(stages);
  if (options.reflect) stats.stage_ms.insert(stats.stage_ms.begin(), {"reflection maps", reflection_ms});
  if (options.shadows != Shadows::off) stats.stage_ms.insert(stats.stage_ms.begin(), {"shadow maps", shadow_ms});
  if (options.count_fragments && chosen.entry->info.bounds) stats.bound_fragments = bound_fragments;
  technique.report(stats);
  return pictures;
}

}  // namespace omma
