#include "omma/technique/renderer.h"

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"
#include "omma/technique/reflection/reflection_maps.h"
#include "omma/technique/registry.h"
#include "omma/technique/shadow/shadow_maps.h"
#include "omma/technique/technique.h"

namespace omma {
namespace {

constexpr int max_samples = 1024;
/// A tile's images are many (samples, depth, channels); larger tiles gain nothing.
constexpr int preferred_tile = 4096;

/// The samples of a picture as passes of up to the driver's samples each.
struct Passes {
  int samples = 1;  ///< in each pass
  std::vector<glm::dvec2> shifts;
};

/// The R2 sequence (Roberts 2018): any first n points are spread evenly.
glm::dvec2 spread_point(int i) {
  return glm::fract(glm::dvec2(0.5) + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532)) - 0.5;
}

Passes plan_passes(int samples, bool multisamples, int driver_samples) {
  Passes passes;
  if (multisamples) {
    // Drivers have powers of two.
    while (passes.samples * 2 <= std::min(samples, driver_samples)) passes.samples *= 2;
  }
  const int count = (samples + passes.samples - 1) / passes.samples;
  // The driver's own sample positions are spread over the pixel; a pass shifts them within the gap between two.
  const double gap = 1.0 / std::sqrt(double(passes.samples));
  for (int i = 0; i < count; ++i) {
    // On the grid of pieces, where it is decided in whole numbers whose a sample is.
    const glm::dvec2 shift = glm::round(gap * spread_point(i) * double(piece_grid)) / double(piece_grid);
    passes.shifts.push_back(count == 1 ? glm::dvec2(0.0) : shift);
  }
  return passes;
}

std::vector<PixelRect> plan_tiles(ImageSize size, int side) {
  std::vector<PixelRect> tiles;
  for (int y = 0; y < size.height; y += side) {
    for (int x = 0; x < size.width; x += side) {
      tiles.push_back({x, y, std::min(x + side, size.width), std::min(y + side, size.height)});
    }
  }
  return tiles;
}

Image make_image(Channel channel, ImageSize size) {
  const ChannelInfo& info = channel_info(channel);
  if (info.integer) return IntImage(size, info.components);
  return FloatImage(size, info.components);
}

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

struct Renderer::Parts {
  gl::Context context;
  const Scene* scene = nullptr;
  std::unique_ptr<GpuScene> gpu_scene;
  std::unique_ptr<DrawTools> tools;
  std::map<std::string, std::unique_ptr<Technique>> techniques;
  std::unique_ptr<ShadowMaps> shadow_maps;
  std::unique_ptr<ReflectionMaps> reflection_maps;
  Target target;

  /// Objects are deleted in the context that is current, which may be another renderer's.
  ~Parts() { context.make_current(); }

  Technique& technique(const ChosenTechnique& chosen) {
    std::unique_ptr<Technique>& technique = techniques[chosen.name()];
    if (!technique) technique = chosen.entry->make(*tools, chosen.variant);
    return *technique;
  }

  const Target& target_for(ImageSize size, std::span<const Channel> outputs) {
    if (!target.fits(size, outputs, 1)) target = Target(size, outputs);
    return target;
  }

  /// Milliseconds that all stages of `draw` took.
  double timed(const std::function<void()>& draw) {
    tools->timer.finish();
    draw();
    double sum = 0.0;
    for (const auto& [stage, ms] : tools->timer.finish()) sum += ms;
    return sum;
  }

  Image draw_color(Technique& technique, View view, const Passes& passes, std::span<const Effect> effects,
                   bool show_pieces);
  void draw_piece_borders(const Technique& technique, const View& view, const Target& picture);
  void draw_channels(Technique& technique, View view, std::map<Channel, Image>& pictures);
};

Image Renderer::Parts::draw_color(Technique& technique, View view, const Passes& passes,
                                  std::span<const Effect> effects, bool show_pieces) {
  static constexpr Channel outputs[] = {Channel::color};
  view.outputs = outputs;
  view.effects = effects;
  view.samples = passes.samples;
  const Target& picture = target_for(view.size(), outputs);
  if (passes.shifts.size() == 1) {
    technique.draw(view, picture);
    if (show_pieces) draw_piece_borders(technique, view, picture);
    tools->timer.mark("read back");
    return read_back(picture.image(Channel::color), Channel::color, view.size());
  }
  // Half floats hold a pass, but not the sum of a thousand.
  const gl::Texture total = gl::Texture::image(GL_RGBA32F, view.size());
  const gl::Framebuffer framebuffer = gl::create_framebuffer();
  glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, total.id(), 0);
  const GLfloat zero[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, zero);
  const gl::Program& add = tools->programs.get(
      {{GL_VERTEX_SHADER, "common/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "common/accumulate.frag"}}, {});
  for (const glm::dvec2& shift : passes.shifts) {
    view.shift = shift;
    technique.draw(view, picture);
    if (show_pieces) draw_piece_borders(technique, view, picture);
    tools->timer.mark("accumulate");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glBindSampler(0, 0);
    picture.image(Channel::color).bind(0);
    add.set("weight", 1.0f / float(passes.shifts.size()));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    tools->draw_fullscreen(add);
    glDisable(GL_BLEND);
  }
  tools->timer.mark("read back");
  return read_back(total, Channel::color, view.size());
}

void Renderer::Parts::draw_piece_borders(const Technique& technique, const View& view, const Target& picture) {
  const Camera* pieces = view.camera.pieces() != nullptr ? &view.camera : technique.pieces();
  if (pieces == nullptr) {
    throw CommandError("there are no pieces to show: technique piecewise draws them, or a camera in the pieces form");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer());
  glViewport(0, 0, view.size().width, view.size().height);
  tools->draw_piece_borders(view, *pieces);
}

void Renderer::Parts::draw_channels(Technique& technique, View view, std::map<Channel, Image>& pictures) {
  std::vector<Channel> outputs;
  for (const auto& [channel, image] : pictures) {
    if (channel != Channel::color) outputs.push_back(channel);
  }
  if (outputs.empty()) return;
  view.outputs = outputs;
  const Target& picture = target_for(view.size(), outputs);
  technique.draw(view, picture);
  tools->timer.mark("read back");
  for (Channel channel : outputs) {
    paste(read_back(picture.image(channel), channel, view.size()), view.tile, pictures.at(channel));
  }
}

Renderer::Renderer() : parts_(std::make_unique<Parts>()) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_CLAMP);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::load(const Scene& scene) {
  Parts& parts = *parts_;
  parts.context.make_current();
  parts.techniques.clear();
  parts.shadow_maps.reset();
  parts.reflection_maps.reset();
  parts.tools.reset();
  parts.scene = &scene;
  parts.gpu_scene = std::make_unique<GpuScene>(scene, parts.context);
  parts.tools = std::unique_ptr<DrawTools>(new DrawTools{parts.context, *parts.gpu_scene});
  parts.shadow_maps = std::make_unique<ShadowMaps>(*parts.tools, *parts.gpu_scene);
  parts.reflection_maps = std::make_unique<ReflectionMaps>(*parts.tools, *parts.gpu_scene);
}

void Renderer::update() {
  if (parts_->gpu_scene == nullptr) throw CommandError("there is no scene to update; call Renderer::load first");
  parts_->context.make_current();
  parts_->gpu_scene->update();
  for (auto& [name, technique] : parts_->techniques) technique->scene_changed();
  parts_->shadow_maps->scene_changed();
  parts_->reflection_maps->scene_changed();
}

std::map<Channel, Image> Renderer::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                          std::span<const Channel> wanted, const RenderOptions& options,
                                          RenderStats* stats) {
  Parts& parts = *parts_;
  if (parts.gpu_scene == nullptr) throw CommandError("there is no scene to render; call Renderer::load first");
  if (wanted.empty()) throw CommandError("no channel is asked for");
  if (options.samples < 1 || options.samples > max_samples) {
    throw CommandError("{} samples per pixel; 1 to {} are possible", options.samples, max_samples);
  }
  if (options.tile < 0 || options.face_size < 0) throw CommandError("a tile or face size cannot be negative");
  if (std::min(options.shadow_size, options.reflection_size) < 16) {
    throw CommandError("a shadow or reflection map of {} texels; 16 or more make one",
                       std::min(options.shadow_size, options.reflection_size));
  }
  const ChosenTechnique chosen = choose_technique(options.technique, camera);
  const std::vector<Effect> effects = effects_of(options);
  check_show(options.show, chosen);
  parts.context.make_current();
  const gl::Limits& limits = parts.context.limits();
  Technique& technique = parts.technique(chosen);
  const double shadow_ms = parts.timed([&] { parts.shadow_maps->use(options.shadows, options.shadow_size); });
  const double reflection_ms = parts.timed([&] { parts.reflection_maps->use(options); });
  parts.gpu_scene->set_view(worldFromCamera, options.background);

  const int most = std::min(limits.texture_size, limits.viewport_size);
  const int side = options.tile > 0 ? std::min(options.tile, most) : std::min(most, preferred_tile);
  const std::vector<PixelRect> tiles = plan_tiles(camera.size(), side);
  const Passes passes = plan_passes(options.samples, technique.multisamples(), limits.samples);

  std::map<Channel, Image> pictures;
  for (Channel channel : wanted) pictures.emplace(channel, make_image(channel, camera.size()));
  parts.tools->counters.finish();
  BoundFragments bound_fragments;
  for (const PixelRect& tile : tiles) {
    View view{.camera = camera, .worldFromCamera = worldFromCamera, .tile = tile};
    view.filter = options.filter;
    view.face_size = options.face_size;
    view.pieces = options.pieces;
    view.show_overdraw = options.show.contains(Show::overdraw);
    view.bound_fragments = options.count_fragments && chosen.entry->info.bounds ? &bound_fragments : nullptr;
    if (pictures.contains(Channel::color)) {
      paste(parts.draw_color(technique, view, passes, effects, options.show.contains(Show::pieces)), tile,
            pictures.at(Channel::color));
    }
    parts.draw_channels(technique, view, pictures);
  }
  const gl::Counts counts = parts.tools->counters.finish();
  auto stages = parts.tools->timer.finish();
  if (stats != nullptr) {
    stats->technique = chosen.name();
    stats->renderer = parts.context.renderer();
    stats->triangles = parts.scene->triangle_count();
    stats->triangles_drawn = size_t(counts.primitives);
    stats->fragments_shaded = counts.fragments;
    stats->samples_kept = counts.samples;
    stats->buffer_bytes = parts.gpu_scene->bytes() + parts.target.bytes() + parts.tools->multisample_target.bytes() +
                          technique.buffer_bytes() + parts.shadow_maps->bytes() + parts.reflection_maps->bytes();
    stats->tiles = int(tiles.size());
    stats->passes = pictures.contains(Channel::color) ? int(passes.shifts.size()) : 0;
    stats->stage_ms = std::move(stages);
    if (options.reflect) stats->stage_ms.insert(stats->stage_ms.begin(), {"reflection maps", reflection_ms});
    if (options.shadows != Shadows::off) stats->stage_ms.insert(stats->stage_ms.begin(), {"shadow maps", shadow_ms});
    if (options.count_fragments && chosen.entry->info.bounds) stats->bound_fragments = bound_fragments;
    technique.report(*stats);
  }
  return pictures;
}

}  // namespace omma
