#include "omma/camera/pieces/piece_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "omma/camera/pieces/flat_pieces.h"

namespace omma {
namespace {

constexpr double negligible_px = 1e-3;
constexpr int64_t narrowest = piece_grid / 4;  // of a row or column

using Lines = std::vector<int64_t>;  // on the grid

struct Rectangle {
  int64_t x0, y0, x1, y1;
  std::array<glm::i64vec2, 4> corners() const {
    return {glm::i64vec2(x0, y0), glm::i64vec2(x1, y0), glm::i64vec2(x1, y1), glm::i64vec2(x0, y1)};
  }
};

// A rectangle's corners with their rays, as long as one linear map has them.
struct Cell {
  std::array<glm::dvec2, 4> pixels;
  std::array<glm::dvec3, 4> rays;

  glm::dmat3 shown() const { return ray_from_image({pixels[0], pixels[1], pixels[3]}, {rays[0], rays[1], rays[3]}); }
};

std::optional<Cell> cell_of(const RayField& field, const Rectangle& rectangle) {
  Cell cell;
  const auto corners = rectangle.corners();
  for (size_t i = 0; i < 4; ++i) {
    cell.pixels[i] = pixel_of(corners[i]);
    cell.rays[i] = field.at(cell.pixels[i]);
  }
  const auto lengths = quad_lengths(cell.pixels, cell.rays);
  if (!lengths) return {};
  for (size_t i = 0; i < 4; ++i) cell.rays[i] *= (*lengths)[i];
  return cell;
}

double error_of(const RayField& field, const Rectangle& rectangle) {
  constexpr double impossible = 1e9;
  const auto cell = cell_of(field, rectangle);
  if (!cell) return impossible;
  const glm::dmat3 shown = cell->shown();
  // Errors of what is linear grow with the square of the extent: fewer points will do where that is small.
  const auto steps_of = [](int64_t extent) { return extent <= 4 * piece_grid ? 2 : 4; };
  const int columns = steps_of(rectangle.x1 - rectangle.x0), rows = steps_of(rectangle.y1 - rectangle.y0);
  double most = 0.0;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const glm::dvec2 share(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
      const glm::dvec2 pixel = glm::mix(cell->pixels[0], cell->pixels[2], share);
      const auto here = field.local(pixel);
      const auto error = here ? here->distance_px(shown * glm::dvec3(pixel, 1.0)) : std::nullopt;
      if (error) most = std::max(most, *error);
    }
  }
  return most;
}

// The fewest lines from `low` to `high` between which the error stays within the tolerance, `narrowest` apart or more;
// nothing when there would be more than `most`.
std::optional<Lines> lines_between(int64_t low, int64_t high, double tolerance_px, size_t most,
                                   const std::function<double(int64_t, int64_t)>& error) {
  Lines lines = {low};
  int64_t guess = high - low;
  while (lines.back() < high) {
    if (lines.size() > most) return {};
    const int64_t from = lines.back();
    const auto fits = [&](int64_t to) { return error(from, to) <= tolerance_px; };
    // The last one was about as wide as the next will be.
    int64_t good = std::min<int64_t>(from + narrowest, high), bad = high + 1;
    for (int64_t step = std::max<int64_t>(guess, 2 * narrowest); good < high;) {
      const int64_t to = std::min(from + step, high);
      if (to >= bad || to <= good) break;
      if (fits(to)) {
        good = to;
        step *= 2;
      } else {
        bad = to;
        step /= 2;
      }
    }
    while (bad - good > std::max<int64_t>(1, (good - from) / 32)) {
      const int64_t middle = good + (bad - good) / 2;
      (fits(middle) ? good : bad) = middle;
    }
    guess = good - from;
    lines.push_back(good);
  }
  return lines;
}

double largest_in_parallel(size_t count, const std::function<double(size_t)>& value) {
  std::vector<double> values(count, 0.0);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) { values[i] = value(i); });
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

// The rays at the nodes of columns and rows, as long as all rectangles' maps have them, and the largest distance
// between what neighbours see on their common edges; nothing where a rectangle has no map.
struct Nodes {
  std::vector<glm::dvec3> rays;
  double mismatch_px = 0.0;
};

std::optional<Nodes> nodes_of(const RayField& field, const Lines& columns, const Lines& rows) {
  const size_t wide = columns.size() - 1, high = rows.size() - 1;
  std::vector<std::optional<Cell>> cells(wide * high);
  tbb::parallel_for(size_t{0}, cells.size(), [&](size_t i) {
    const size_t x = i % wide, y = i / wide;
    cells[i] = cell_of(field, {columns[x], rows[y], columns[x + 1], rows[y + 1]});
  });
  if (!std::ranges::all_of(cells, [](const auto& cell) { return cell.has_value(); })) return {};
  // Each is made as long as its neighbour at a corner that they have in common.
  const auto scale = [](Cell& cell, size_t corner, double length) {
    const double factor = length / glm::length(cell.rays[corner]);
    for (glm::dvec3& ray : cell.rays) ray *= factor;
  };
  for (size_t y = 0; y < high; ++y) {
    for (size_t x = 0; x < wide; ++x) {
      Cell& cell = *cells[y * wide + x];
      if (x > 0) {
        scale(cell, 0, glm::length(cells[y * wide + x - 1]->rays[1]));
      } else if (y > 0) {
        scale(cell, 0, glm::length(cells[(y - 1) * wide]->rays[3]));
      }
    }
  }
  Nodes nodes;
  nodes.rays.resize(columns.size() * rows.size());
  for (size_t y = 0; y < high; ++y) {
    for (size_t x = 0; x < wide; ++x) {
      const Cell& cell = *cells[y * wide + x];
      const auto compare = [&](const Cell& other, size_t a, size_t b, size_t other_a, size_t other_b) {
        const auto here = field.local(0.5 * (cell.pixels[a] + cell.pixels[b]));
        if (!here) return;
        nodes.mismatch_px = std::max(nodes.mismatch_px, here->distance_px(cell.rays[a] + cell.rays[b],
                                                                          other.rays[other_a] + other.rays[other_b]));
        // Lengths that differ would break depth.
        const double longer = glm::length(cell.rays[b]) / glm::length(other.rays[other_b]);
        if (std::abs(longer - 1.0) > 1e-4) nodes.mismatch_px = std::max(nodes.mismatch_px, 1.0);
      };
      if (x > 0) compare(*cells[y * wide + x - 1], 0, 3, 1, 2);
      if (y > 0) compare(*cells[(y - 1) * wide + x], 0, 1, 3, 2);
      for (const auto& [corner, dx, dy] :
           {std::tuple(0, 0, 0), std::tuple(1, 1, 0), std::tuple(2, 1, 1), std::tuple(3, 0, 1)}) {
        nodes.rays[(y + static_cast<size_t>(dy)) * columns.size() + x + static_cast<size_t>(dx)] =
            cell.rays[static_cast<size_t>(corner)];
      }
    }
  }
  return nodes;
}

std::optional<PieceRows> pieces_between(const ImagePart& part, const SeenPixels& seen, const Lines& columns,
                                        const Lines& rows) {
  const auto nodes = nodes_of(part.field, columns, rows);
  if (!nodes || nodes->mismatch_px > negligible_px) return {};
  // Of length 1 where the part is in its middle.
  const double unit = 1.0 / glm::length(nodes->rays[nodes->rays.size() / 2]);
  PieceRows result{{}, static_cast<int>(columns.size()) - 1, static_cast<int>(rows.size()) - 1};
  for (size_t y = 0; y + 1 < rows.size(); ++y) {
    for (size_t x = 0; x + 1 < columns.size(); ++x) {
      const auto corners = Rectangle{columns[x], rows[y], columns[x + 1], rows[y + 1]}.corners();
      const std::array<glm::dvec2, 4> pixels = {pixel_of(corners[0]), pixel_of(corners[1]), pixel_of(corners[2]),
                                                pixel_of(corners[3])};
      if (!seen.any_in(pixels)) continue;
      const auto ray = [&](size_t dx, size_t dy) { return unit * nodes->rays[(y + dy) * columns.size() + x + dx]; };
      const auto piece =
          flat_piece(corners, ray_from_image({pixels[0], pixels[1], pixels[3]}, {ray(0, 0), ray(1, 0), ray(0, 1)}));
      if (!piece) return {};
      result.pieces.push_back(*piece);
    }
  }
  return result;
}

Lines equal_lines(int64_t low, int64_t high, int count) {
  Lines lines;
  for (int i = 0; i <= count; ++i) lines.push_back(low + (high - low) * i / count);
  return lines;
}

// The error of a row, or a column, as it would be if those that cross it were thin.
double thin_error(const ImagePart& part, bool row, int64_t from, int64_t to) {
  constexpr int samples = 7;
  const glm::i64vec2 low = part.corners[0], high = part.corners[2];
  const int64_t thin = 2 * piece_grid;
  double most = 0.0;
  for (int i = 0; i < samples; ++i) {
    const int64_t extent = row ? high.x - low.x : high.y - low.y;
    const int64_t at = (row ? low.x : low.y) + std::max<int64_t>(0, extent - thin) * i / (samples - 1);
    const int64_t end = std::min(at + thin, row ? high.x : high.y);
    most = std::max(most, error_of(part.field, row ? Rectangle{at, from, end, to} : Rectangle{from, at, to, end}));
  }
  return most;
}

}  // namespace

bool fits_rows(const ImagePart& part) {
  const glm::i64vec2 low = part.corners[0], high = part.corners[2];
  const auto nodes = nodes_of(part.field, equal_lines(low.x, high.x, 7), equal_lines(low.y, high.y, 6));
  return nodes && nodes->mismatch_px <= negligible_px;
}

std::optional<PieceRows> piece_rows(const ImagePart& part, const SeenPixels& seen, double tolerance_px, size_t most) {
  const glm::i64vec2 low = part.corners[0], high = part.corners[2];
  struct Found {
    Lines first, second;
    bool rows_first = true;
    size_t count() const { return (first.size() - 1) * (second.size() - 1); }
  };
  std::optional<Found> best;
  // Where there are many rows their errors follow from those of some.
  const auto whole_error = [&](const Lines& first, bool rows_first) {
    return [&part, &first, rows_first](int64_t from, int64_t to) {
      const size_t last = first.size() - 2, samples = std::min<size_t>(last, 15);
      return largest_in_parallel(samples + 1, [&](size_t sample) {
        const size_t i = samples > 0 ? sample * last / samples : 0;
        const int64_t a = first[i], b = first[i + 1];
        return error_of(part.field, rows_first ? Rectangle{from, a, to, b} : Rectangle{a, from, b, to});
      });
    };
  };
  const auto thin_lines = [&](bool rows, double share) {
    return lines_between(rows ? low.y : low.x, rows ? high.y : high.x, share * tolerance_px, most,
                         [&](int64_t from, int64_t to) { return thin_error(part, rows, from, to); });
  };
  // Those come first of which there are fewer; then the others, with what they leave of the tolerance.
  const auto few_rows = thin_lines(true, 0.5), few_columns = thin_lines(false, 0.5);
  if (!few_rows && !few_columns) return {};
  const bool rows_first = few_rows && (!few_columns || few_rows->size() <= few_columns->size());
  for (const double share : {0.5, 0.25}) {
    const auto first = share == 0.5 ? (rows_first ? few_rows : few_columns) : thin_lines(rows_first, share);
    if (!first) continue;
    const auto second =
        lines_between(rows_first ? low.x : low.y, rows_first ? high.x : high.y, tolerance_px,
                      (best ? best->count() : most) / (first->size() - 1), whole_error(*first, rows_first));
    if (!second) continue;
    const Found found{*first, *second, rows_first};
    if (!best || found.count() < best->count()) best = found;
    if (first->size() == 2) break;
  }
  if (!best) return {};
  return pieces_between(part, seen, best->rows_first ? best->second : best->first,
                        best->rows_first ? best->first : best->second);
}

std::optional<PieceRows> piece_columns(const ImagePart& part, const SeenPixels& seen, int columns) {
  const glm::i64vec2 low = part.corners[0], high = part.corners[2];
  constexpr double straight_px = 0.02;  // between columns of two pixels
  if (thin_error(part, true, low.y, high.y) > straight_px || columns > (high.x - low.x) / piece_grid) return {};
  return pieces_between(part, seen, equal_lines(low.x, high.x, columns), {low.y, high.y});
}

}  // namespace omma
