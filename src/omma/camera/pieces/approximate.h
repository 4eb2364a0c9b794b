// Pieces for any camera: as few as keep the picture within a tolerance, or as many as are asked for.
#pragma once

#include <optional>

#include "omma/camera/camera.h"
#include "omma/camera/pieces/piece_set.h"

namespace omma {

/// How far pieces are from the camera they stand for, measured in the image: a piece shows at a pixel what the camera
/// shows so many pixels away.
struct PieceError {
  double max_px = 0.0, mean_px = 0.0, p95_px = 0.0;
  glm::dvec2 worst{0.0};  ///< pixel
  size_t points = 0;      ///< of the image that were measured
};

inline constexpr double default_tolerance_px = 0.25;

struct PieceOptions {
  std::optional<double> tolerance_px{};  ///< 0.01 to 100; nothing: the default, or a camera's own pieces as they are
  int count = 0;                         ///< above 0: about so many pieces of equal size, whatever the error
  friend bool operator==(const PieceOptions&, const PieceOptions&) = default;
};

struct Approximation {
  PieceSet pieces;
  PieceError error;
  std::string layout;  ///< `strips`, `quads`, `triangles`, `exact`
};

/// The pieces that stand for a camera. One in the pieces form is taken as it is unless options say otherwise.
/// Throws CommandError for options out of range.
Approximation approximate(const Camera& camera, const PieceOptions& options = {});

/// Measures at no less than `points` points spread evenly over the image, where both have a ray.
PieceError measure_pieces(const PieceSet& pieces, const Camera& camera, size_t points = 100000);

}  // namespace omma
