// Rectangles in rows and columns, for cameras that are flat along the image's axes: cylinders, panoramas of latitude
// and longitude.
#pragma once

#include <optional>
#include <vector>

#include "omma/camera/pieces/image_parts.h"

namespace omma {

struct PieceRows {
  std::vector<Piece> pieces;  ///< without those that see nothing
  int columns = 0, rows = 0;
};

/// True when rectangles in rows and columns see the same along their edges as their neighbours do, to 0.001 px. The
/// part is a rectangle.
bool fits_rows(const ImagePart& part);

/// As few rectangles as keep the measured error within the tolerance, or nothing where they are more than `most` or do
/// not meet. The part fits_rows.
std::optional<PieceRows> piece_rows(const ImagePart& part, const SeenPixels& seen, double tolerance_px, size_t most);

/// `columns` of equal width, in one row; nothing where one row does not show upright lines as the camera does.
std::optional<PieceRows> piece_columns(const ImagePart& part, const SeenPixels& seen, int columns);

}  // namespace omma
