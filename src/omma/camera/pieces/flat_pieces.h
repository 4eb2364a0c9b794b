// Pieces from rays at their corners.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "omma/camera/pieces/piece_set.h"

namespace omma {

/// The linear map that has these rays at three pixels.
glm::dmat3 ray_from_image(const std::array<glm::dvec2, 3>& pixels, const std::array<glm::dvec3, 3>& rays);

/// How long the rays of a quad's corners must be for one linear map to have all four, the first of length 1; nothing
/// where no positive lengths do.
std::optional<std::array<double, 4>> quad_lengths(const std::array<glm::dvec2, 4>& corners,
                                                  const std::array<glm::dvec3, 4>& rays);

/// The same for a triangle and a fourth ray within it.
std::optional<std::array<double, 3>> triangle_lengths(const std::array<glm::dvec2, 3>& corners,
                                                      const std::array<glm::dvec3, 3>& rays, const glm::dvec2& pixel,
                                                      const glm::dvec3& ray);

/// A piece with these corners, clockwise as seen, that shows `rayFromImage`; nothing where that has no inverse.
std::optional<Piece> flat_piece(std::span<const glm::i64vec2> corners, const glm::dmat3& rayFromImage);

}  // namespace omma
