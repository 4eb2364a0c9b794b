#include "omma/camera/pieces/piece_set.h"

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"
#include "omma/camera/pieces/places.h"

namespace omma {
namespace {

bool is_on_grid(double pixels) { return pixels * piece_grid == std::round(pixels * piece_grid); }

// What is wrong with a piece; empty when nothing is.
std::string fault_of(const Piece& piece) {
  if (piece.corner_count != 3 && piece.corner_count != 4) {
    return fmt::format("has {} corners; 3 or 4 are accepted", piece.corner_count);
  }
  for (int i = 0; i < piece.corner_count; ++i) {
    const glm::dvec2& corner = piece.corners[static_cast<size_t>(i)];
    // Also false for what is no number.
    const bool near = std::abs(corner.x) <= max_piece_corner && std::abs(corner.y) <= max_piece_corner;
    if (!near) {
      return fmt::format("has a corner at ({}, {}); up to {} pixels from the image's origin are accepted", corner.x,
                         corner.y, max_piece_corner);
    }
    if (!is_on_grid(corner.x) || !is_on_grid(corner.y)) {
      return fmt::format("has a corner at ({}, {}); multiples of 1/{} of a pixel are accepted", corner.x, corner.y,
                         piece_grid);
    }
  }
  const PolygonOnGrid polygon(piece);
  for (int i = 0; i < polygon.count; ++i) {
    if (polygon.edge(i, polygon.at(i + 2)) <= 0) {
      return "is no convex polygon with its corners clockwise as seen (y is down), none on the line between two others";
    }
  }
  return {};
}

// Pixels that a point lies outside of the polygon at most, 0 within.
double outside_by(const Piece& piece, const glm::dvec2& point) {
  double most = 0.0;
  for (int i = 0; i < piece.corner_count; ++i) {
    const glm::dvec2& from = piece.corners[static_cast<size_t>(i)];
    const glm::dvec2 along = piece.corners[static_cast<size_t>((i + 1) % piece.corner_count)] - from;
    const double inwards = along.x * (point.y - from.y) - along.y * (point.x - from.x);
    most = std::max(most, -inwards / glm::length(along));
  }
  return most;
}

}  // namespace

glm::i64vec2 on_piece_grid(const glm::dvec2& pixel) {
  // Beyond the corners' range nothing is owned; the clamp keeps whole numbers whole.
  constexpr double range = 4.0 * max_piece_corner;
  return glm::i64vec2(glm::round(glm::clamp(pixel, -range, range) * static_cast<double>(piece_grid)));
}

bool owns(const Piece& piece, const glm::i64vec2& place) {
  const PolygonOnGrid polygon(piece);
  for (int i = 0; i < polygon.count; ++i) {
    const int64_t side = polygon.edge(i, place);
    if (side < 0) return false;
    if (side > 0) continue;
    const glm::i64vec2 along = polygon.at(i + 1) - polygon.at(i);
    if (!(along.y < 0 || (along.y == 0 && along.x > 0))) return false;
  }
  return true;
}

PieceSet::PieceSet(ImageSize size, std::vector<Piece> pieces, std::string source)
    : size_(size), pieces_(std::move(pieces)), source_(std::move(source)) {
  const std::string beginning = source_.empty() ? "" : source_ + ": ";
  constexpr int most = 65536;
  if (size_.width < 1 || size_.height < 1 || size_.width > most || size_.height > most) {
    throw CommandError("{}size: an image of {} x {} pixels; 1 to {} a side is accepted", beginning, size_.width,
                       size_.height, most);
  }
  if (pieces_.empty()) throw CommandError("{}pieces: there are none; at least one is needed", beginning);
  rayFromImage_.reserve(pieces_.size());
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const std::string fault = fault_of(pieces_[i]);
    if (!fault.empty()) throw CommandError("{}pieces[{}] {}", beginning, i, fault);
    if (!has_inverse(pieces_[i].imageFromRay)) {
      throw CommandError("{}pieces[{}].imageFromRay is singular; it must have an inverse", beginning, i);
    }
    rayFromImage_.push_back(glm::inverse(pieces_[i].imageFromRay));
  }
  fill_bins(beginning);
  find_contested();
}

std::optional<uint32_t> PieceSet::owner(const glm::dvec2& pixel) const {
  if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return {};
  const glm::i64vec2 place = on_piece_grid(pixel);
  constexpr int64_t side = int64_t{bin_side} * piece_grid;
  // The first square lies before the image.
  const int64_t column = (place.x + side) / side, row = (place.y + side) / side;
  if (place.x < -side || place.y < -side || column >= bin_counts_.x || row >= bin_counts_.y) return {};
  const auto bin = static_cast<size_t>(row * bin_counts_.x + column);
  for (uint32_t i = bin_first_[bin]; i < bin_first_[bin + 1]; ++i) {
    if (owns(pieces_[bin_pieces_[i]], place)) return bin_pieces_[i];
  }
  return {};
}

std::optional<glm::dvec3> PieceSet::unproject(const glm::dvec2& pixel) const {
  std::optional<uint32_t> piece = owner(pixel);
  if (!piece) {
    const glm::dvec2 end(size_.width, size_.height);
    const glm::dvec2 last = end - 1.0 / piece_grid;
    const bool on_edge = (pixel.x > last.x && pixel.x <= end.x) || (pixel.y > last.y && pixel.y <= end.y);
    if (!on_edge) return {};
    piece = owner(glm::min(pixel, last));
    if (!piece) return {};
  }
  return glm::normalize(rayFromImage_[*piece] * glm::dvec3(pixel, 1.0));
}

std::optional<glm::dvec2> PieceSet::project(const glm::dvec3& direction) const {
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0.0) || !std::isfinite(direction.x + direction.y + direction.z)) return {};
  constexpr double rounding = 1.0 / piece_grid;
  std::optional<glm::dvec2> beside;
  for (uint32_t i = 0; i < pieces_.size(); ++i) {
    const glm::dvec3 seen = pieces_[i].imageFromRay * (direction / largest);
    if (!(seen.z > 0.0)) continue;
    const glm::dvec2 pixel = glm::dvec2(seen) / seen.z;
    const bool close = !(std::abs(pixel.x) > max_piece_corner + 1) && !(std::abs(pixel.y) > max_piece_corner + 1);
    if (!close || outside_by(pieces_[i], pixel) > rounding) continue;
    const bool own = owns(pieces_[i], on_piece_grid(pixel));
    if (own && (!contested_[i] || owner(pixel).value_or(i) == i)) return pixel;
    if (!own && !beside && !contested_[i]) beside = pixel;
  }
  return beside;
}

}  // namespace omma
