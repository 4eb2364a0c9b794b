#include "omma/technique/image_based/image_based.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "omma/base/error.h"
#include "omma/technique/image_based/cube.h"
#include "omma/technique/mesh_pass.h"
#include "omma/technique/planar/planar.h"

namespace omma {
namespace {

enum class Variant { seen, passes, layered };

constexpr int face_count = 6;
constexpr int mipmap_levels = 5;

/// A face, or the part of one, that is drawn.
struct Face {
  int number;  ///< of the cube
  ImageSize size;
  glm::dmat4 clipFromCamera;
  glm::vec2 scale, offset;  ///< tangents to texels
};

/// One array per channel with a layer per drawn face, and a framebuffer per layer.
struct FaceImages {
  ImageSize size;
  std::vector<Channel> outputs;
  int levels = 1;
  std::vector<gl::Texture> images;
  gl::Texture depth;
  std::vector<gl::Framebuffer> layers;

  FaceImages() = default;
  FaceImages(ImageSize layer_size, std::span<const Channel> channels, int layer_count, int level_count)
      : size(layer_size),
        outputs(channels.begin(), channels.end()),
        levels(level_count),
        depth(gl::Texture::image(depth_format, layer_size)),
        layers(size_t(layer_count)) {
    std::vector<GLenum> attachments;
    for (Channel channel : channels) {
      attachments.push_back(GLenum(GL_COLOR_ATTACHMENT0 + images.size()));
      images.push_back(gl::Texture::array(gl_format(channel), size, layer_count, levels));
    }
    if (outputs.front() == Channel::color) {
      images.front().filter(levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR);
    }
    for (size_t layer = 0; layer < layers.size(); ++layer) {
      layers[layer] = gl::create_framebuffer();
      for (size_t i = 0; i < images.size(); ++i) {
        glNamedFramebufferTextureLayer(layers[layer].id(), attachments[i], images[i].id(), 0, GLint(layer));
      }
      glNamedFramebufferTexture(layers[layer].id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
      glNamedFramebufferDrawBuffers(layers[layer].id(), GLsizei(attachments.size()), attachments.data());
    }
  }

  bool fit(ImageSize layer_size, std::span<const Channel> channels, size_t layer_count, int level_count) const {
    return size == layer_size && std::equal(outputs.begin(), outputs.end(), channels.begin(), channels.end()) &&
           layers.size() == layer_count && levels == level_count;
  }
};

class ImageBased : public Technique {
 public:
  ImageBased(DrawTools& tools, Variant variant) : tools_(tools), variant_(variant) {}
  bool multisamples() const override { return true; }

  void draw(const View& view, const Target& target) override {
    plan(view);
    tools_.timer.mark("faces");
    if (variant_ == Variant::layered) {
      draw_layered(view);
    } else {
      draw_passes(view);
    }
    if (images_.levels > 1) {
      tools_.timer.mark("mipmaps");
      glGenerateTextureMipmap(images_.images.front().id());
    }
    tools_.timer.mark("resample");
    resample(view, target);
  }

  size_t buffer_bytes() const override {
    size_t texels = 0;
    if (!images_.layers.empty()) {
      texels = size_t(images_.size.width) * size_t(images_.size.height) * images_.layers.size();
    }
    return texels * 8 + multisample_.bytes() + layered_.bytes();
  }

 private:
  /// Texels around a window that filters may reach into.
  int margin(const View& view) const { return view.labels() ? 1 : view.anisotropic() ? 16 : 2; }

  int face_texels(const View& view) const {
    if (view.face_size > 0) return view.face_size;
    return std::max(1, int(std::ceil(2.0 * view.camera.pixels_per_radian())));
  }

  /// Which faces to draw, how large, and the images for them.
  void plan(const View& view) {
    const int texels = face_texels(view);
    const int border = margin(view);
    const double texel = 2.0 / texels;  // in tangents
    const bool mipmapped = view.anisotropic() && !view.labels();
    // Windows begin and end on the face's own grid of texels, and on that of its smallest mipmap: no texel depends on
    // how much of its face is seen, and tiles fit together.
    const int grid = mipmapped ? 1 << (mipmap_levels - 1) : 1;
    std::array<FaceWindow, face_count> windows;
    if (variant_ == Variant::seen) {
      if (windows_camera_ != view.camera || windows_tile_ != view.tile) {
        windows_ = seen_windows(view.camera, view.tile);
        windows_camera_ = view.camera;
        windows_tile_ = view.tile;
      }
      windows = windows_;
    } else {
      windows.fill({glm::dvec2(-1.0), glm::dvec2(1.0)});
    }

    faces_.clear();
    ImageSize size{1, 1};
    const int most = std::min(tools_.context.limits().texture_size, tools_.context.limits().viewport_size);
    double largest = 0.0;
    for (int f = 0; f < face_count; ++f) {
      const FaceWindow& window = windows[size_t(f)];
      if (window.empty()) continue;
      const auto from_edge = [](const glm::dvec2& tangent) { return glm::clamp(tangent, -1.0, 1.0) + 1.0; };
      const glm::dvec2 first = glm::floor((from_edge(window.min) / texel - double(border)) / double(grid) + 1e-6);
      const glm::dvec2 last = glm::ceil((from_edge(window.max) / texel + double(border)) / double(grid) - 1e-6);
      // Each pass samples the faces elsewhere, too: otherwise more samples would not smooth what the faces hold.
      const glm::dvec2 shift = view.shift * texel - 1.0;
      const glm::dvec2 min = first * (grid * texel) + shift, end = last * (grid * texel) + shift;
      const glm::dvec2 count = (last - first) * double(grid);
      largest = std::max({largest, count.x, count.y});
      if (largest > most) continue;
      Face face{f, {int(count.x), int(count.y)}, {}, glm::vec2(1.0 / texel), glm::vec2(-min / texel)};
      face.clipFromCamera =
          clip_from_flat_frame({min.x, end.x}, {min.y, end.y}) * glm::dmat4(faceFromCamera[size_t(f)]);
      size = {std::max(size.width, face.size.width), std::max(size.height, face.size.height)};
      faces_.push_back(face);
    }
    if (largest > most) {
      throw MachineError(
          "cube faces of {:.0f} texels are too large for this driver, which draws up to {}; give a smaller "
          "--face-size or --tile",
          largest, most);
    }
    for (Face& face : faces_) {
      if (variant_ == Variant::layered) face.size = size;
      face.scale /= glm::vec2(size.width, size.height);
      face.offset /= glm::vec2(size.width, size.height);
    }
    const int levels =
        mipmapped ? std::min(mipmap_levels, int(std::bit_width(unsigned(std::max(size.width, size.height))))) : 1;
    const size_t layer_count = std::max<size_t>(1, faces_.size());
    if (!images_.fit(size, view.outputs, layer_count, levels)) {
      images_ = FaceImages(size, view.outputs, int(layer_count), levels);
    }
  }

  MeshPass pass_to(const glm::dmat4& clipFromCamera, const glm::dmat4& clipFromWorld) const {
    return {
        .stages = {{GL_VERTEX_SHADER, "technique/mesh.vert"}},
        .defines = {},
        .set_uniforms =
            [clipFromCamera](const gl::Program& program) { program.set("clipFromCamera", glm::mat4(clipFromCamera)); },
        .may_be_seen = [clipFromWorld](const Bounds& world) { return may_be_in_frustum(clipFromWorld, world); }};
  }

  void draw_passes(const View& view) {
    const glm::dmat4 cameraFromWorld = glm::inverse(view.worldFromCamera);
    if (view.samples() > 1 && !multisample_.fits(images_.size, view.outputs, view.samples())) {
      multisample_ = Target(images_.size, view.outputs, view.samples());
    }
    MeshDrawer drawer(tools_);
    for (size_t layer = 0; layer < faces_.size(); ++layer) {
      const Face& face = faces_[layer];
      const GLuint destination = images_.layers[layer].id();
      const GLuint framebuffer = view.samples() > 1 ? multisample_.framebuffer() : destination;
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
      clear_outputs(framebuffer, view.outputs);
      glViewport(0, 0, face.size.width, face.size.height);
      drawer.draw(pass_to(face.clipFromCamera, face.clipFromCamera * cameraFromWorld), view);
      if (view.samples() > 1) copy(framebuffer, destination, face.size, view.outputs.size());
    }
  }

  void draw_layered(const View& view) {
    if (!layered_.fits(images_.size, view.outputs, view.samples(), face_count)) {
      layered_ = Target(images_.size, view.outputs, view.samples(), face_count);
    }
    std::array<glm::mat4, face_count> clips;
    std::array<int, face_count> layers;
    for (size_t f = 0; f < face_count; ++f) {
      clips[f] = glm::mat4(faces_[f].clipFromCamera);
      layers[f] = int(f);
    }
    layered_.begin();
    MeshDrawer(tools_).draw(
        {.stages = {{GL_VERTEX_SHADER, "technique/mesh.vert"}, {GL_GEOMETRY_SHADER, "technique/faces.geom"}},
         .defines = {{"FACE_COUNT", std::to_string(face_count)}},
         .set_uniforms =
             [&](const gl::Program& program) {
               program.set("face_clipFromCamera", std::span<const glm::mat4>(clips));
               program.set("layer", std::span<const int>(layers));
             },
         .may_be_seen = [](const Bounds&) { return true; }},
        view);
    const gl::Framebuffer source = gl::create_framebuffer();
    for (size_t layer = 0; layer < faces_.size(); ++layer) {
      for (size_t i = 0; i < view.outputs.size(); ++i) {
        glNamedFramebufferTextureLayer(source.id(), GLenum(GL_COLOR_ATTACHMENT0 + i),
                                       layered_.image(view.outputs[i]).id(), 0, GLint(layer));
      }
      copy(source.id(), images_.layers[layer].id(), images_.size, view.outputs.size());
    }
  }

  /// Every attachment, averaged where the source has several samples.
  static void copy(GLuint source, GLuint destination, ImageSize size, size_t attachments) {
    for (size_t i = 0; i < attachments; ++i) {
      const auto attachment = GLenum(GL_COLOR_ATTACHMENT0 + i);
      glNamedFramebufferReadBuffer(source, attachment);
      glNamedFramebufferDrawBuffer(destination, attachment);
      glBlitNamedFramebuffer(source, destination, 0, 0, size.width, size.height, 0, 0, size.width, size.height,
                             GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
  }

  void resample(const View& view, const Target& target) {
    std::array<glm::vec2, face_count> scale{}, offset{};
    std::array<int, face_count> layer{};
    std::array<glm::mat3, face_count> frames;
    for (size_t f = 0; f < face_count; ++f) frames[f] = glm::mat3(faceFromCamera[f]);
    for (size_t i = 0; i < faces_.size(); ++i) {
      const auto f = size_t(faces_[i].number);
      scale[f] = faces_[i].scale;
      offset[f] = faces_[i].offset;
      layer[f] = int(i);
    }
    target.begin();
    tools_.scene.bind();
    tools_.camera_textures.bind(view.camera);
    for (size_t i = 0; i < view.outputs.size(); ++i) {
      const ChannelInfo& info = channel_info(view.outputs[i]);
      gl::Defines defines = camera_defines(view.camera);
      if (!view.labels()) defines["OUTPUT_COLOR"] = "0";
      if (view.anisotropic()) defines["FILTER_ANISOTROPIC"] = "1";
      if (tools_.context.software()) defines["FILTER_TAPS"] = "1";
      if (info.integer) defines["INTEGER"] = "1";
      const gl::Program& program = tools_.programs.get(
          {{GL_VERTEX_SHADER, "common/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "technique/resample.frag"}}, defines);
      set_camera(program, view);
      program.set("face_scale", std::span<const glm::vec2>(scale));
      program.set("face_offset", std::span<const glm::vec2>(offset));
      program.set("face_layer", std::span<const int>(layer));
      program.set("faceFromCamera", std::span<const glm::mat3>(frames));
      program.set("nothing", glm::vec4(info.nothing));
      program.set("integer_nothing", int(info.nothing));
      glBindSampler(0, 0);
      images_.images[i].bind(0);
      target.draw_only(view.outputs[i]);
      tools_.draw_fullscreen(program);
    }
    target.draw_all();
  }

  DrawTools& tools_;
  Variant variant_;
  std::vector<Face> faces_;
  FaceImages images_;
  Target multisample_, layered_;
  std::array<FaceWindow, face_count> windows_{};
  std::optional<Camera> windows_camera_;
  PixelRect windows_tile_;
};

const std::vector<VariantInfo> variants{
    {"seen", "one pass for each face that the camera sees, and only the part of it that it sees"},
    {"passes", "one pass for each of the six faces"},
    {"layered", "all six faces in one pass; a geometry shader culls each triangle for each face"},
};

}  // namespace

const TechniqueEntry image_based_technique{
    {.name = "image-based",
     .description = "a cube map, resampled: what everybody ships, and the baseline of the benchmarks",
     .exact = false,
     .needs_project = false,
     .variants = variants},
    [](DrawTools& tools, const std::string& variant) -> std::unique_ptr<Technique> {
      const Variant chosen = variant == "passes"    ? Variant::passes
                             : variant == "layered" ? Variant::layered
                                                    : Variant::seen;
      return std::make_unique<ImageBased>(tools, chosen);
    }};

}  // namespace omma
