// One pass over one tile of a picture: what a technique is asked to draw.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/technique/picture.h"
#include "omma/technique/sample_places.h"

namespace omma {

struct View {
  const Camera& camera;
  glm::dmat4 worldFromCamera;
  PixelRect tile;                        ///< of the camera's image
  glm::dvec2 shift{0.0};                 ///< where in its pixel this pass samples, from the centre, pixels
  std::span<const glm::dvec2> shifts{};  ///< instead, where this pass takes several samples; none of labels
  std::span<const Channel> outputs{};    ///< {color}, channels other than color, or none: depth
  /// Where in its pixel the driver samples, beside the shift, as far as the technique multisamples.
  std::span<const glm::ivec2> sample_places = one_sample_place;
  std::span<const Effect> effects{};  ///< on color
  Filter filter = Filter::anisotropic;
  int face_size = 0;
  PieceOptions pieces{};

  bool show_overdraw = false;                 ///< instead of colour
  BoundFragments* bound_fragments = nullptr;  ///< added to where they are to be counted

  int samples() const { return int(sample_places.size()); }
  bool labels() const { return outputs.empty() || outputs.front() != Channel::color; }
  /// Where in its pixel this pass samples, all of it.
  std::span<const glm::dvec2> all_shifts() const {
    return shifts.empty() ? std::span<const glm::dvec2>(&shift, 1) : shifts;
  }
  bool anisotropic() const { return filter == Filter::anisotropic; }
  ImageSize size() const { return {tile.width(), tile.height()}; }
  /// What is added to gl_FragCoord to get a pixel of the image.
  glm::vec2 pixel_offset() const { return glm::dvec2(tile.x0, tile.y0) + shift; }
};

}  // namespace omma
