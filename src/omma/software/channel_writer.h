// Every channel of a picture but its colour: values at what rays meet.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/image/pixel_buffer.h"
#include "omma/scene/scene.h"
#include "omma/software/seen_triangle.h"
#include "omma/visibility/finder.h"

namespace omma {

class ChannelWriter {
 public:
  /// Into those of `outputs` that are no colour, of a picture of this size; filled with what there is where nothing is.
  /// The instances, by their number, and the memory must outlive this object.
  ChannelWriter(std::span<const SeenInstance> instances, const glm::dmat4& worldFromCamera,
                std::span<const Output> outputs, ImageSize size);

  /// What the rays of a block meet. Several threads may write blocks at once.
  void write(const RayBlock& block, const BlockPicture& picture) const;

 private:
  bool needs_point() const { return distance_ || z_ || normal_ || position_ || uv_; }
  void write(const SeenTriangle& triangle, const glm::dvec3& direction, const SeenPoint& point, int x, int y) const;

  std::span<const SeenInstance> instances_;
  glm::dmat4 worldFromCamera_;
  /// Without memory are those that are not wanted.
  PixelRows<float> distance_, z_, normal_, position_, uv_;
  PixelRows<int32_t> id_, object_, material_;
};

}  // namespace omma
