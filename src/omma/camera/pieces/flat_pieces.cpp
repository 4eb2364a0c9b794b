#include "omma/camera/pieces/flat_pieces.h"

#include <cmath>

#include "omma/camera/pieces/places.h"

namespace omma {
namespace {

// The solution of columns * x = right; nothing where there is none that is positive.
std::optional<glm::dvec3> positive_solution(const glm::dmat3& columns, const glm::dvec3& right) {
  const double determinant = glm::determinant(columns);
  if (!(std::abs(determinant) > 1e-14)) return {};
  const glm::dvec3 solution = glm::inverse(columns) * right;
  if (!(solution.x > 0.0 && solution.y > 0.0 && solution.z > 0.0)) return {};
  return solution;
}

glm::dmat3 homogeneous(const std::array<glm::dvec2, 3>& pixels) {
  return {glm::dvec3(pixels[0], 1.0), glm::dvec3(pixels[1], 1.0), glm::dvec3(pixels[2], 1.0)};
}

}  // namespace

glm::dmat3 ray_from_image(const std::array<glm::dvec2, 3>& pixels, const std::array<glm::dvec3, 3>& rays) {
  // Relative to a corner: the image's origin may be far away.
  const glm::dvec2 a = pixels[1] - pixels[0], b = pixels[2] - pixels[0];
  const glm::dvec3 along_a = rays[1] - rays[0], along_b = rays[2] - rays[0];
  const double area = a.x * b.y - a.y * b.x;
  const glm::dvec3 dx = (b.y * along_a - a.y * along_b) / area, dy = (a.x * along_b - b.x * along_a) / area;
  return {dx, dy, rays[0] - pixels[0].x * dx - pixels[0].y * dy};
}

std::optional<std::array<double, 4>> quad_lengths(const std::array<glm::dvec2, 4>& corners,
                                                  const std::array<glm::dvec3, 4>& rays) {
  // The third corner, opposite to the first, as a sum of the others.
  const glm::dvec3 share =
      glm::inverse(homogeneous({corners[0], corners[1], corners[3]})) * glm::dvec3(corners[2], 1.0);
  const auto lengths = positive_solution({share.x * rays[0], share.y * rays[1], share.z * rays[3]}, rays[2]);
  if (!lengths) return {};
  return std::array<double, 4>{1.0, lengths->y / lengths->x, 1.0 / lengths->x, lengths->z / lengths->x};
}

std::optional<std::array<double, 3>> triangle_lengths(const std::array<glm::dvec2, 3>& corners,
                                                      const std::array<glm::dvec3, 3>& rays, const glm::dvec2& pixel,
                                                      const glm::dvec3& ray) {
  const glm::dvec3 share = glm::inverse(homogeneous(corners)) * glm::dvec3(pixel, 1.0);
  const auto lengths = positive_solution({share.x * rays[0], share.y * rays[1], share.z * rays[2]}, ray);
  if (!lengths) return {};
  return std::array<double, 3>{1.0, lengths->y / lengths->x, lengths->z / lengths->x};
}

std::optional<Piece> flat_piece(std::span<const glm::i64vec2> corners, const glm::dmat3& rayFromImage) {
  Piece piece;
  piece.corner_count = static_cast<int>(corners.size());
  for (size_t i = 0; i < corners.size(); ++i)
    piece.corners[i] = glm::dvec2(corners[i]) / static_cast<double>(piece_grid);
  piece.imageFromRay = glm::inverse(rayFromImage);
  if (!has_inverse(piece.imageFromRay)) return {};
  return piece;
}

}  // namespace omma
