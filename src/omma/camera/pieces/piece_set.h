// A camera made of perspective pieces (Lorenz, Döllner 2009, section 2): each shows its part of the image with one
// matrix, as a graphics card draws. Cylinder strips, cells of a camera texture, faces of a cube, facets of a display.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "omma/math/ray.h"

namespace omma {

/// Corners of pieces lie on this grid, in parts of a pixel: whose a sample is, is decided in whole numbers.
inline constexpr int piece_grid = 256;

/// They lie no further than this from the image's origin along either axis, pixels: what is computed of whole numbers
/// then fits 64 bits.
inline constexpr int max_piece_corner = 131072;

/// One perspective part of an image: what `imageFromRay` shows within a convex polygon.
struct Piece {
  int corner_count = 4;                 ///< 3 or 4
  std::array<glm::dvec2, 4> corners{};  ///< pixels, multiples of 1 / piece_grid, clockwise as seen (y is down)
  /// (x w, y w, w) of a direction in the camera frame, (x, y) its pixel. w is positive for what the piece sees (the
  /// negative matrix sees the opposite), and a point that neighbours see on their common border has the same w in both
  /// where approximate() made them: 1 / w serves as depth.
  glm::dmat3 imageFromRay{1.0};
  friend bool operator==(const Piece&, const Piece&) = default;
};

/// A sample's place in whole parts of the grid.
glm::i64vec2 on_piece_grid(const glm::dvec2& pixel);

/// True when a place on the grid is the polygon's: inside, or on those of its edges that run up (y falls), or to the
/// right where level. Of two pieces with a common edge exactly one owns each place on it.
bool owns(const Piece& piece, const glm::i64vec2& place);

/// Pieces and the image they make up. Where pieces overlap the earlier one is seen.
class PieceSet {
 public:
  PieceSet() = default;
  /// Throws CommandError, beginning with `source`, for a piece that is no convex clockwise polygon on the grid or has a
  /// singular matrix; for a set without pieces, and for one that covers the image hundreds of times over.
  PieceSet(ImageSize size, std::vector<Piece> pieces, std::string source = "");

  ImageSize size() const { return size_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::string& source() const { return source_; }  ///< the file it was read from, if any

  /// Number of the piece that a point, rounded to the grid, belongs to: of the image, or up to bin_side beside it where
  /// pieces reach further.
  std::optional<uint32_t> owner(const glm::dvec2& pixel) const;
  /// Unit direction in the camera frame. The image's right and bottom edges, which no piece need own, show what is next
  /// to them.
  std::optional<glm::dvec3> unproject(const glm::dvec2& pixel) const;
  /// Pixel of a direction: of the first piece that shows it. Looks at every piece. Finds what unproject gave, also
  /// where rounding has moved it across a border.
  std::optional<glm::dvec2> project(const glm::dvec3& direction) const;

  /// Ray (any length) of a pixel as the piece shows it; linear in (x, y, 1).
  const glm::dmat3& rayFromImage(uint32_t piece) const { return rayFromImage_[piece]; }

  /// True when an earlier piece lies over a part of this one.
  bool contested(uint32_t piece) const { return contested_[piece]; }

  /// Squares of `bin_side` pixels, row by row over the image and a border of one square all around: which pieces reach
  /// into each. `bin_first` has one entry more than there are squares.
  static constexpr int bin_side = 32;
  glm::ivec2 bin_counts() const { return bin_counts_; }
  std::span<const uint32_t> bin_first() const { return bin_first_; }
  std::span<const uint32_t> bin_pieces() const { return bin_pieces_; }

  friend bool operator==(const PieceSet&, const PieceSet&) = default;

 private:
  void fill_bins(const std::string& beginning);
  void find_contested();

  ImageSize size_;
  std::vector<Piece> pieces_;
  std::string source_;
  std::vector<glm::dmat3> rayFromImage_;
  std::vector<bool> contested_;
  glm::ivec2 bin_counts_{0};
  std::vector<uint32_t> bin_first_, bin_pieces_;
};

}  // namespace omma
