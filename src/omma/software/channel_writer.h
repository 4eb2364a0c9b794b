// Every channel of a picture but its colour: values at what rays meet.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "omma/image/image.h"
#include "omma/scene/scene.h"
#include "omma/software/seen_triangle.h"
#include "omma/visibility/finder.h"

namespace omma {

/// True where it needs the materials' look: colour.
inline bool is_shaded(Channel channel) { return channel == Channel::color; }

class ChannelWriter {
 public:
  /// Into those of `images` that are no colour: of the size of the camera's image, and filled with what there is where
  /// nothing is. The instances, by their number, and the images must outlive this object.
  ChannelWriter(std::span<const SeenInstance> instances, const glm::dmat4& worldFromCamera,
                std::map<Channel, Image>& images);

  /// What the rays of a block meet. Several threads may write blocks at once.
  void write(const RayBlock& block, const BlockPicture& picture) const;

 private:
  bool needs_point() const { return distance_ || z_ || normal_ || position_ || uv_; }
  void write(const SeenTriangle& triangle, const glm::dvec3& direction, const SeenPoint& point, int x, int y) const;

  std::span<const SeenInstance> instances_;
  glm::dmat4 worldFromCamera_;
  /// Null are those that are not wanted.
  FloatImage *distance_ = nullptr, *z_ = nullptr, *normal_ = nullptr, *position_ = nullptr, *uv_ = nullptr;
  IntImage *id_ = nullptr, *object_ = nullptr, *material_ = nullptr;
};

}  // namespace omma
