// How wide lines are drawn and how far apart strokes lie, measured in pictures of a scene made for it.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/scene/scene.h"

namespace omma::bench {

/// A ball of 5 metres radius around the origin, 36 triangles around and 18 down, to be seen from within: unlit, of one
/// grey (0 to 1, linear), texture coordinates along longitude and latitude.
Scene make_measuring_ball(float grey);

/// Ink is what a picture of black on white lacks of white. Widths in pixels of the lines drawn along the triangles'
/// edges: the ink across the middle of each edge that has no other near.
std::vector<double> edge_line_widths(const FloatImage& picture, const Scene& ball, const Camera& camera,
                                     const glm::dmat4& worldFromCamera);

struct Strokes {
  std::vector<double> spacings;  ///< pixels, one a place in the image; a stroke counts by its share of a full one
  std::vector<double> widths;    ///< pixels, of the full strokes there
};

/// Strokes across the direction in which v rises. `uv` is the channel of the same picture.
Strokes measure_strokes(const FloatImage& picture, const FloatImage& uv);

struct Spread {
  size_t count = 0;
  double low = 0.0, median = 0.0, high = 0.0;  ///< low and high: 5th and 95th percentile
};
Spread spread_of(std::span<const double> values);

}  // namespace omma::bench
