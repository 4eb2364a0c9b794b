// Pieces in whole numbers: polygons on the grid, and on which side of an edge a place lies.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "omma/camera/pieces/piece_set.h"

namespace omma {

/// False where rows that nearly lie in a plane leave the inverse no more than six digits.
inline bool has_inverse(const glm::dmat3& matrix) {
  const glm::dmat3 rows = glm::transpose(matrix);
  const double size = glm::length(rows[0]) * glm::length(rows[1]) * glm::length(rows[2]);
  // Written so that NaN fails; beyond these sizes products overflow or vanish.
  return size > 1e-100 && size < 1e100 && std::abs(glm::determinant(matrix)) > 1e-10 * size;
}

/// A piece's corners in parts of a pixel.
struct PolygonOnGrid {
  int count = 0;
  std::array<glm::i64vec2, 4> corners{};

  explicit PolygonOnGrid(const Piece& piece) : count(piece.corner_count) {
    for (size_t i = 0; i < static_cast<size_t>(count); ++i) corners[i] = on_piece_grid(piece.corners[i]);
  }

  const glm::i64vec2& at(int i) const { return corners[static_cast<size_t>(i % count)]; }

  /// Positive inside of the edge that begins at corner i, 0 on its line.
  int64_t edge(int i, const glm::i64vec2& place) const {
    const glm::i64vec2 along = at(i + 1) - at(i), to = place - at(i);
    return along.x * to.y - along.y * to.x;
  }

  glm::i64vec2 low() const {
    glm::i64vec2 low = at(0);
    for (int i = 1; i < count; ++i) low = glm::min(low, at(i));
    return low;
  }
  glm::i64vec2 high() const {
    glm::i64vec2 high = at(0);
    for (int i = 1; i < count; ++i) high = glm::max(high, at(i));
    return high;
  }

  /// True when one of this polygon's edges has all of the other on its outer side or on it.
  bool has_edge_before(const PolygonOnGrid& other) const {
    for (int i = 0; i < count; ++i) {
      bool all_outside = true;
      for (int j = 0; j < other.count && all_outside; ++j) all_outside = edge(i, other.at(j)) <= 0;
      if (all_outside) return true;
    }
    return false;
  }

  /// True when they have more than edges or corners in common. Convex polygons that do not are kept apart by an edge of
  /// one of them.
  bool overlaps(const PolygonOnGrid& other) const { return !has_edge_before(other) && !other.has_edge_before(*this); }

  /// False only when no place of the rectangle, its edges included, is this polygon's or on its edges.
  bool meets(const glm::i64vec2& rectangle_low, const glm::i64vec2& rectangle_high) const {
    const glm::i64vec2 own_low = low(), own_high = high();
    if (own_low.x > rectangle_high.x || own_low.y > rectangle_high.y || own_high.x < rectangle_low.x ||
        own_high.y < rectangle_low.y) {
      return false;
    }
    for (int i = 0; i < count; ++i) {
      const glm::i64vec2 along = at(i + 1) - at(i);
      // The rectangle's corner that is furthest inside.
      const glm::i64vec2 inmost(along.y > 0 ? rectangle_low.x : rectangle_high.x,
                                along.x > 0 ? rectangle_high.y : rectangle_low.y);
      if (edge(i, inmost) < 0) return false;
    }
    return true;
  }
};

}  // namespace omma
