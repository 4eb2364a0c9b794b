// Pictures by the processor alone: no OpenGL, no driver, no display.
//
// The values are those that the techniques draw (docs/conventions.md). Colour is that of the shaders of
// shaders/shading, compiled for the processor; every other channel is sampled at the pixel's centre, never blended, a
// blended surface solid where it covers at least half, masked materials with their holes.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "omma/base/shared_cache.h"
#include "omma/camera/camera.h"
#include "omma/image/pixel_buffer.h"
#include "omma/scene/scene.h"
#include "omma/shading/effects.h"
#include "omma/software/mip_texture.h"
#include "omma/software/shadow_depths.h"
#include "omma/software/surroundings.h"
#include "omma/visibility/finder.h"
#include "omma/visibility/recent_rays.h"

namespace omma {

class ChannelWriter;
class ColorRows;

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
  std::stop_token stop{};        ///< asked to stop, drawing ends between two squares, by throwing Cancelled
};

/// What a picture took.
struct SoftwareStats {
  std::vector<std::pair<std::string, double>> stage_ms;  ///< wall clock
  int passes = 0;                                        ///< of colour
  uint64_t fragments = 0;                                ///< that were shaded, the background's apart
  size_t bytes = 0;  ///< of the finder, its cameras and the textures; not of the pictures
};

/// Pictures of one scene, several at once: what they need of it is made once, and shared.
class SoftwareRenderer {
 public:
  /// The index, and its scene, must outlive this object.
  explicit SoftwareRenderer(const LazySceneIndex& index) : scene_(&index.scene()), index_(&index) {}

  /// The scene has changed so, and the index with it. While nothing is drawn.
  void update(const SceneChanges& changes);

  /// Writes a picture of the camera's size: colour linear, or encoded where the output is; lengths in metres, `normal`
  /// and `position` in the world's frame, what channels() says where nothing is. `worldFromCamera` is rigid. No channel
  /// has two outputs. Runs on all cores; the result is the same on any number of them. May be called by several threads
  /// at once. Throws CommandError for no output or one that omma::check refuses, no sample, effects that check_effects
  /// refuses and an object that is not there, MachineError for textures and maps too large.
  void render(const Camera& camera, const glm::dmat4& worldFromCamera, std::span<const Output> outputs,
              const SoftwareOptions& options = {}, SoftwareStats* stats = nullptr) const;
  /// The same into images of its own.
  std::map<Channel, Image> render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  std::span<const Channel> wanted, const SoftwareOptions& options = {},
                                  SoftwareStats* stats = nullptr) const;

 private:
  using Textures = std::vector<MipTexture>;
  struct ShadowKey {
    Shadows kind;
    int size;
    friend bool operator==(const ShadowKey&, const ShadowKey&) = default;
  };
  /// What surroundings depend on beside the scene.
  struct SurroundingsKey {
    int object, size;
    std::optional<glm::vec3> background;
    ShadowKey shadows;
    friend bool operator==(const SurroundingsKey&, const SurroundingsKey&) = default;
  };

  std::shared_ptr<const Textures> textures() const;
  std::shared_ptr<const ShadowDepths> shadow_depths(const ShadowKey& key) const;
  /// What surrounds options.reflect, drawn where it is not there.
  std::shared_ptr<const Surroundings> surroundings_of(const SoftwareOptions& options) const;
  /// Without `hidden_object`; writes what the first samples find to `channels`, too, if there are any.
  void draw_color(const Camera& camera, const glm::dmat4& worldFromCamera, const SoftwareOptions& options,
                  std::optional<int> hidden_object, const ColorRows& to, SoftwareStats& stats,
                  const ChannelWriter* channels = nullptr) const;
  void draw_channels(const Camera& camera, const glm::dmat4& worldFromCamera, const ChannelWriter& writer,
                     const std::stop_token& stop, SoftwareStats& stats) const;
  size_t bytes() const;

  const Scene* scene_;
  const LazySceneIndex* index_;
  mutable RecentRays rays_;
  mutable SharedCache<size_t, Textures, 1> textures_;  ///< by how many there are
  mutable SharedCache<ShadowKey, ShadowDepths, 2> shadow_depths_;
  mutable SharedCache<SurroundingsKey, Surroundings, 2> surroundings_;
};

}  // namespace omma
