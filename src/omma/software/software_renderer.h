// Pictures by the processor alone: no OpenGL, no driver, no display.
//
// The values are those that the techniques draw (docs/conventions.md). Colour is that of the shaders of
// shaders/shading, compiled for the processor; every other channel is sampled at the pixel's centre, never blended, a
// blended surface solid where it covers at least half, masked materials with their holes.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/scene/scene.h"
#include "omma/shading/effects.h"
#include "omma/software/mip_texture.h"
#include "omma/software/shadow_depths.h"
#include "omma/software/surroundings.h"
#include "omma/visibility/finder.h"
#include "omma/visibility/recent_rays.h"

namespace omma {

class ChannelWriter;

/// How colour is made.
struct SoftwareOptions {
  int samples = 4;                        ///< per pixel, 1 or more
  bool anisotropic = true;                ///< up to sixteen samples of a texture along a pixel's longer axis
  std::optional<glm::vec3> background{};  ///< linear RGB where a ray meets nothing; nothing: a sky
  std::vector<Effect> effects{};          ///< one after another, as check_effects accepts them
  Shadows shadows = Shadows::off;
  int shadow_size = 1024;        ///< texels along a shadow map, 16 or more
  std::optional<int> reflect{};  ///< the object whose surfaces show what surrounds it
  int reflection_size = 512;     ///< texels along each of its two maps, 16 or more
};

/// What a picture took.
struct SoftwareStats {
  std::vector<std::pair<std::string, double>> stage_ms;  ///< wall clock
  int passes = 0;                                        ///< of colour
  uint64_t fragments = 0;                                ///< that were shaded, the background's apart
  size_t bytes = 0;  ///< of the finder, its cameras and the textures; not of the pictures
};

class SoftwareRenderer {
 public:
  /// Sorts the scene's triangles. The scene must outlive this object.
  explicit SoftwareRenderer(const Scene& scene) : scene_(&scene), finder_(scene) {}

  /// Takes over what set_time changed: transforms, lights and deformed vertices.
  void update() {
    finder_.update();
    shadow_depths_.scene_changed();
    surroundings_.reset();
  }

  /// The image of every channel asked for, of the camera's size: colour linear, lengths in metres, `normal` and
  /// `position` in the world's frame, what channels() says where nothing is. `worldFromCamera` is rigid. Runs on all
  /// cores; the result is the same on any number of them. Throws CommandError for no channel, no sample, a effects that
  /// check_effects refuses and an object that is not there, MachineError for textures and maps too large.
  std::map<Channel, Image> render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  std::span<const Channel> wanted, const SoftwareOptions& options = {},
                                  SoftwareStats* stats = nullptr);

 private:
  void prepare_textures();
  /// Without `hidden_object`; writes what the first samples find to `channels`, too, if there are any.
  void draw_color(const Camera& camera, const glm::dmat4& worldFromCamera, const SoftwareOptions& options,
                  std::optional<int> hidden_object, FloatImage& image, SoftwareStats& stats,
                  const ChannelWriter* channels = nullptr);
  /// What surrounds options.reflect, drawn where it is not there.
  const Surroundings& surroundings_of(const SoftwareOptions& options);
  void draw_channels(const Camera& camera, const glm::dmat4& worldFromCamera, const ChannelWriter& writer,
                     SoftwareStats& stats);

  const Scene* scene_;
  Finder finder_;
  std::vector<MipTexture> textures_;
  RecentRays rays_;
  ShadowDepths shadow_depths_;
  /// What surroundings depend on beside the scene.
  struct SurroundingsKey {
    int object, size;
    std::optional<glm::vec3> background;
    Shadows shadows;
    int shadow_size;
    friend bool operator==(const SurroundingsKey&, const SurroundingsKey&) = default;
  };
  SurroundingsKey surroundings_key_{};
  std::optional<Surroundings> surroundings_;
};

}  // namespace omma
