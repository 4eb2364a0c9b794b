// A tree of squares over an image, each with a cone around all rays of its pixels and samples: where a triangle may be
// seen through any camera, without projecting anything.
#pragma once

#include <optional>
#include <vector>

#include "omma/image/image.h"
#include "omma/technique/nonlinear/ray_grid.h"

namespace omma {

/// A square of pixels of a view's tile.
struct ImageSquare {
  int x = 0, y = 0, side = 0;
  WideCone cone{};                     ///< around its rays
  std::optional<LinearRays> linear{};  ///< where its rays change evenly
  bool whole = false;                  ///< sees something everywhere
  int descendants = 0;                 ///< squares that follow and lie within this one
};

/// Squares end where their rays are a linear function of the pixel but for this; pixels.
constexpr double linear_within_px = 1.0;

/// The squares in which the camera sees anything, of 1, 2, 4, 8, … pixels a side, each before those that lie in it.
/// `shifted`: passes may sample up to half a pixel beside.
std::vector<ImageSquare> image_squares(const Camera& camera, const PixelRect& tile, bool shifted);

}  // namespace omma
