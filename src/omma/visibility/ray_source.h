// The rays of an image by squares of 16 x 16 pixels, whoever has them: kept in memory, or made when they are asked for.
#pragma once

#include <span>
#include <vector>

#include "omma/math/ray.h"
#include "omma/visibility/ray_block.h"

namespace omma {

/// Squares one after another.
struct RaySquares {
  std::span<const RayBlock> blocks;            ///< of each square one for each of its samples; a mask of 0 says no ray
  std::span<const SquareBorder> borders;       ///< of each square one, around the first sample's rays
  std::span<const BlockOrigins> origins = {};  ///< by the blocks; empty where all rays begin at the camera's centre
};

/// Where squares are made. Each thread has its own.
struct RayRoom {
  std::vector<RayBlock> blocks;
  std::vector<SquareBorder> borders;
};

/// May be asked by several threads at once.
class RaySource {
 public:
  virtual ~RaySource() = default;
  virtual ImageSize size() const = 0;
  /// Rays a pixel.
  virtual int samples() const = 0;
  /// Neighbours are near to each other; some may be without rays.
  virtual size_t squares() const = 0;
  /// Callers ask for few at once: `room` grows with `count`. What is returned lasts until `room` is used again, or as
  /// long as this object.
  virtual RaySquares some(size_t first, size_t count, RayRoom& room) const = 0;
};

}  // namespace omma
