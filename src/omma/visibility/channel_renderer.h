// Every channel of a picture but its colour, on the processor alone: no OpenGL, no driver, no display.
//
// The values are those that the techniques draw (docs/conventions.md): sampled at the pixel's centre, never blended, a
// blended surface solid where it covers at least half, masked materials with their holes.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/scene/scene.h"
#include "omma/visibility/finder.h"

namespace omma {

/// True where it needs the materials' look, and with it a GPU: colour.
inline bool is_shaded(Channel channel) { return channel == Channel::color; }

/// What a picture took.
struct ChannelStats {
  double rays_ms = 0.0;  ///< wall clock: the camera's rays and their tree; 0 where they are those of the last picture
  double find_ms = 0.0;  ///< wall clock: everything else
  int tiles = 0;
  size_t bytes = 0;  ///< of the finder and its rays; not of the pictures
};

class ChannelRenderer {
 public:
  /// Sorts the scene's triangles. The scene must outlive this object.
  explicit ChannelRenderer(const Scene& scene) : scene_(&scene), finder_(scene) {}

  /// Takes over what set_time changed: transforms and deformed vertices.
  void update() { finder_.update(); }

  /// The image of every channel asked for, of the camera's size: lengths in metres, `normal` and `position` in the
  /// world's frame, what channels() says where nothing is. `worldFromCamera` is rigid. `tile`: pixels along the side of
  /// what is found at once, 0 for a good number; it bounds the memory, not the picture. Runs on all cores; the result
  /// is the same on any number of them. Throws CommandError for color, for no channel, and for a negative tile.
  std::map<Channel, Image> render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  std::span<const Channel> wanted, int tile = 0, ChannelStats* stats = nullptr);

 private:
  const RayTree& rays_of_tile(const Camera& camera, const PixelRect& tile);

  const Scene* scene_;
  Finder finder_;
  /// The last picture's, which the next one mostly shares.
  std::optional<Camera> camera_;
  PixelRect tile_;
  RayTree rays_;
};

}  // namespace omma
