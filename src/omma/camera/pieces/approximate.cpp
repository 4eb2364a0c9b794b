#include "omma/camera/pieces/approximate.h"

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"
#include "omma/camera/pieces/flat_pieces.h"
#include "omma/camera/pieces/image_parts.h"
#include "omma/camera/pieces/piece_mesh.h"
#include "omma/camera/pieces/piece_rows.h"

namespace omma {
namespace {

constexpr double exact_px = 1e-6;
constexpr size_t most_pieces = 1'000'000;

// A part as a single piece, and its error; nothing where no linear map has its corners' rays.
struct SinglePiece {
  Piece piece;
  double error_px = 0.0;
};

std::optional<SinglePiece> single_piece(const ImagePart& part) {
  std::array<glm::dvec2, 4> corners{};
  std::array<glm::dvec3, 4> rays{};
  glm::dvec2 middle(0.0);
  const size_t count = part.corners.size();
  if (count > 4) return {};
  for (size_t i = 0; i < count; ++i) {
    corners[i] = pixel_of(part.corners[i]);
    rays[i] = part.field.at(corners[i]);
    middle += corners[i] / static_cast<double>(count);
  }
  const std::array triangle = {corners[0], corners[1], corners[count == 3 ? 2 : 3]};
  std::array triangle_rays = {rays[0], rays[1], rays[count == 3 ? 2 : 3]};
  if (count == 3) {
    const auto lengths = triangle_lengths(triangle, triangle_rays, middle, part.field.at(middle));
    if (!lengths) return {};
    for (size_t i = 0; i < 3; ++i) triangle_rays[i] *= (*lengths)[i];
  } else {
    const auto lengths = quad_lengths(corners, rays);
    if (!lengths) return {};
    triangle_rays = {rays[0], (*lengths)[1] * rays[1], (*lengths)[3] * rays[3]};
  }
  const glm::dmat3 shown = ray_from_image(triangle, triangle_rays);
  const auto piece = flat_piece(part.corners, shown / glm::length(shown * glm::dvec3(middle, 1.0)));
  if (!piece) return {};
  SinglePiece result{*piece, 0.0};
  constexpr int steps = 24;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      // Over a quad, or twice over a triangle.
      const glm::dvec2 pixel =
          count == 4 ? glm::mix(glm::mix(corners[0], corners[1], u), glm::mix(corners[3], corners[2], u), v)
                     : glm::mix(corners[0], glm::mix(corners[1], corners[2], u), v);
      const auto here = part.field.local(pixel);
      const auto error = here ? here->distance_px(shown * glm::dvec3(pixel, 1.0)) : std::nullopt;
      if (error) result.error_px = std::max(result.error_px, *error);
    }
  }
  return result;
}

struct Layout {
  std::vector<Piece> pieces;
  std::string name;
};

// Makes a piece's rays as long as its neighbour's where both see the same along a common edge; false where they do not.
bool match_lengths(Piece& piece, const Piece& neighbour) {
  std::vector<double> factors;
  for (int i = 0; i < piece.corner_count; ++i) {
    const glm::dvec2& corner = piece.corners[static_cast<size_t>(i)];
    const auto end = neighbour.corners.begin() + neighbour.corner_count;
    if (std::find(neighbour.corners.begin(), end, corner) == end) continue;
    const glm::dvec3 own = glm::inverse(piece.imageFromRay) * glm::dvec3(corner, 1.0);
    const glm::dvec3 other = glm::inverse(neighbour.imageFromRay) * glm::dvec3(corner, 1.0);
    if (glm::distance(glm::normalize(own), glm::normalize(other)) > 1e-4) continue;
    factors.push_back(glm::length(other) / glm::length(own));
  }
  if (factors.size() != 2 || std::abs(factors[0] / factors[1] - 1.0) > 1e-4) return false;
  piece.imageFromRay /= factors[0];
  return true;
}

// So that depth goes on from piece to piece wherever the world does.
void match_lengths(std::vector<Piece>& pieces) {
  for (size_t i = 1; i < pieces.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (match_lengths(pieces[i], pieces[j])) break;
    }
  }
}

// One piece for each part, where that is within the tolerance.
std::optional<Layout> single_pieces(std::span<const ImagePart> parts, double tolerance_px) {
  Layout layout{{}, "exact"};
  for (const ImagePart& part : parts) {
    const auto single = single_piece(part);
    if (!single || single->error_px > tolerance_px) return {};
    if (single->error_px > exact_px) layout.name = single->piece.corner_count == 4 ? "quads" : "triangles";
    layout.pieces.push_back(single->piece);
  }
  match_lengths(layout.pieces);
  return layout;
}

std::optional<Layout> rows_of(std::span<const ImagePart> parts, const SeenPixels& seen, double tolerance_px) {
  if (!std::ranges::all_of(parts, &ImagePart::is_rectangle) || !std::ranges::all_of(parts, fits_rows)) return {};
  Layout layout{{}, "strips"};
  for (const ImagePart& part : parts) {
    const auto rows = piece_rows(part, seen, tolerance_px, most_pieces);
    if (!rows) return {};
    if (rows->rows > 1 && rows->columns > 1) layout.name = "quads";
    layout.pieces.insert(layout.pieces.end(), rows->pieces.begin(), rows->pieces.end());
  }
  return layout;
}

Layout triangles_of(std::span<const ImagePart> parts, const SeenPixels& seen, double tolerance_px, size_t most) {
  // Which surface needs the fewest shows at a coarser tolerance, too.
  CornerSurface best = CornerSurface::sphere;
  size_t fewest = most;
  for (const CornerSurface surface : {CornerSurface::sphere, CornerSurface::cylinder, CornerSurface::plane}) {
    PieceMesh mesh(parts, seen, surface);
    if (!mesh.refine(8.0 * tolerance_px, fewest) || mesh.size() >= fewest) continue;
    fewest = mesh.size();
    best = surface;
  }
  PieceMesh mesh(parts, seen, best);
  mesh.refine(tolerance_px, most);
  return {mesh.pieces(), "triangles"};
}

Layout equal_pieces(std::span<const ImagePart> parts, const SeenPixels& seen, int count) {
  if (parts.size() == 1 && parts[0].is_rectangle() && fits_rows(parts[0])) {
    if (const auto columns = piece_columns(parts[0], seen, count)) return {columns->pieces, "strips"};
  }
  PieceMesh mesh(parts, seen, CornerSurface::sphere);
  mesh.split_to(static_cast<size_t>(count));
  return {mesh.pieces(), "triangles"};
}

}  // namespace

Approximation approximate(const Camera& camera, const PieceOptions& options) {
  const double tolerance_px = options.tolerance_px.value_or(default_tolerance_px);
  if (!(tolerance_px >= 0.01 && tolerance_px <= 100.0)) {
    throw CommandError("pieces: a tolerance of {} px is out of range; 0.01 to 100 is accepted", tolerance_px);
  }
  if (options.count < 0 || options.count > static_cast<int>(most_pieces)) {
    throw CommandError("pieces: a count of {} is out of range; 1 to {}, or 0 for as few as the tolerance needs",
                       options.count, most_pieces);
  }
  if (camera.pieces() && options.count == 0 && !options.tolerance_px) {
    return {*camera.pieces(), measure_pieces(*camera.pieces(), camera), "exact"};
  }
  const SeenPixels seen(camera);
  const std::vector<ImagePart> parts = image_parts(camera, seen);
  if (parts.empty()) throw CommandError("pieces: the camera sees nothing in its image");

  std::optional<Layout> layout;
  if (options.count > 0) {
    layout = equal_pieces(parts, seen, options.count);
  } else {
    layout = single_pieces(parts, tolerance_px);
    if (!layout) layout = rows_of(parts, seen, tolerance_px);
    // Triangles of a few pixels show no more than the pixels do.
    const size_t most =
        std::min(most_pieces, static_cast<size_t>(camera.size().width) * camera.size().height / 16 + 1000);
    if (!layout) layout = triangles_of(parts, seen, tolerance_px, most);
  }
  PieceSet pieces(camera.size(), std::move(layout->pieces));
  const PieceError error = measure_pieces(pieces, camera);
  return {std::move(pieces), error, layout->name};
}

}  // namespace omma
