#include "omma/camera/pieces/piece_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr int most_squares = 4096;  // along a side

// Where a convex polygon lies between two heights: its least and its largest x; nothing where it does not.
std::optional<std::pair<double, double>> span_between(std::span<const glm::dvec2> corners, double top, double bottom) {
  double low = 1e300, high = -1e300;
  const auto add = [&](double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  };
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if (a.y >= top && a.y <= bottom) add(a.x);
    for (const double y : {top, bottom}) {
      if ((a.y < y) != (b.y < y)) add(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
  }
  if (low > high) return {};
  return std::pair(low, high);
}

std::pair<double, double> heights_of(std::span<const glm::dvec2> corners) {
  const auto [low, high] = std::ranges::minmax_element(corners, {}, &glm::dvec2::y);
  return {low->y, high->y};
}

int square_of(double pixels, int step, int count) {
  return static_cast<int>(std::clamp(std::floor(pixels / step), 0.0, static_cast<double>(count)));
}

}  // namespace

SeenPixels::SeenPixels(const Camera& camera) {
  const ImageSize size = camera.size();
  step_ = (std::max(size.width, size.height) + most_squares - 1) / most_squares;
  squares_ = {(size.width + step_ - 1) / step_, (size.height + step_ - 1) / step_};
  before_.assign(static_cast<size_t>(squares_.width + 1) * squares_.height, 0);
  tbb::parallel_for(0, squares_.height, [&](int y) {
    int* row = before_.data() + static_cast<size_t>(y) * (squares_.width + 1);
    for (int x = 0; x < squares_.width; ++x) {
      const glm::dvec2 centre = (glm::dvec2(x, y) + 0.5) * static_cast<double>(step_);
      const glm::dvec2 inside = glm::min(centre, glm::dvec2(size.width, size.height) - 0.5);
      row[x + 1] = row[x] + (camera.unproject(inside) ? 1 : 0);
    }
  });
}

bool SeenPixels::any_in(std::span<const glm::dvec2> corners) const {
  const auto [low, high] = heights_of(corners);
  const int first = square_of(low - step_, step_, squares_.height),
            last = square_of(high + step_, step_, squares_.height - 1);
  for (int y = first; y <= last; ++y) {
    const auto span = span_between(corners, (y - 1.0) * step_, (y + 2.0) * step_);
    if (!span) continue;
    const int* row = before_.data() + static_cast<size_t>(y) * (squares_.width + 1);
    const int from = square_of(span->first - step_, step_, squares_.width);
    const int to = square_of(span->second + step_, step_, squares_.width - 1);
    if (from <= to && row[to + 1] > row[from]) return true;
  }
  return false;
}

std::vector<glm::dvec2> SeenPixels::within(std::span<const glm::dvec2> corners, size_t most) const {
  std::vector<glm::dvec2> ends, others;
  const auto [low, high] = heights_of(corners);
  const int first = square_of(low, step_, squares_.height), last = square_of(high, step_, squares_.height - 1);
  for (int y = first; y <= last; ++y) {
    const double height = (y + 0.5) * step_;
    const auto span = span_between(corners, height, height);
    if (!span) continue;
    const int* row = before_.data() + static_cast<size_t>(y) * (squares_.width + 1);
    const size_t row_begin = others.size();
    for (int x = square_of(span->first, step_, squares_.width); x < squares_.width && (x + 0.5) * step_ <= span->second;
         ++x) {
      if ((x + 0.5) * step_ < span->first || row[x + 1] == row[x]) continue;
      others.push_back((glm::dvec2(x, y) + 0.5) * static_cast<double>(step_));
    }
    if (others.size() == row_begin) continue;
    ends.push_back(others[row_begin]);
    ends.push_back(others.back());
  }
  const size_t every = (others.size() + most - 1) / std::max<size_t>(most, 1);
  for (size_t i = 0; i < others.size(); i += every) ends.push_back(others[i]);
  return ends;
}

PixelRect SeenPixels::bounds() const {
  PixelRect bounds{squares_.width, squares_.height, 0, 0};
  for (int y = 0; y < squares_.height; ++y) {
    const int* row = before_.data() + static_cast<size_t>(y) * (squares_.width + 1);
    if (row[squares_.width] == 0) continue;
    bounds.y0 = std::min(bounds.y0, y);
    bounds.y1 = y + 1;
    bounds.x0 = std::min(bounds.x0, static_cast<int>(std::upper_bound(row, row + squares_.width + 1, 0) - row) - 1);
    bounds.x1 = std::max(bounds.x1,
                         static_cast<int>(std::lower_bound(row, row + squares_.width + 1, row[squares_.width]) - row));
  }
  return {bounds.x0 * step_, bounds.y0 * step_, bounds.x1 * step_, bounds.y1 * step_};
}

PieceError measure_pieces(const PieceSet& pieces, const Camera& camera, size_t points) {
  const ImageSize size = camera.size();
  const RayField field(camera, {}, {0.5 * size.width, 0.5 * size.height});
  const double spacing =
      std::sqrt(static_cast<double>(size.width) * size.height / static_cast<double>(std::max<size_t>(points, 1)));
  const int columns = std::max(1, static_cast<int>(std::ceil(size.width / spacing)));
  const int rows = std::max(1, static_cast<int>(std::ceil(size.height / spacing)));
  struct Sample {
    double error = -1.0;
    glm::dvec2 pixel{0.0};
  };
  std::vector<Sample> samples(static_cast<size_t>(columns) * rows);
  tbb::parallel_for(0, rows, [&](int row) {
    for (int column = 0; column < columns; ++column) {
      // Shifted from row to row: points that stand in columns would miss what repeats.
      const double shift = std::fmod(0.5 + 0.618033988749895 * row, 1.0);
      const glm::dvec2 pixel((column + shift) * size.width / columns, (row + 0.5) * size.height / rows);
      const auto owner = pieces.owner(pixel);
      if (!owner) continue;
      const glm::dvec3 shown = pieces.rayFromImage(*owner) * glm::dvec3(pixel, 1.0);
      const auto here = field.local(pixel);
      auto error = here ? here->distance_px(shown) : std::nullopt;
      if (!error) continue;
      // Corners on the grid move an edge between parts of the world by as much as half of its spacing.
      constexpr double rounding = 1.0 / piece_grid;
      if (*error > 4.0 * rounding) {
        for (const glm::dvec2& aside : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
          const auto there = field.local(pixel + rounding * aside);
          const auto other = there ? there->distance_px(shown) : std::nullopt;
          if (other) error = std::min(*error, *other + rounding);
        }
      }
      samples[static_cast<size_t>(row) * columns + column] = {*error, pixel};
    }
  });
  std::erase_if(samples, [](const Sample& sample) { return sample.error < 0.0; });
  PieceError result;
  result.points = samples.size();
  if (samples.empty()) return result;
  for (const Sample& sample : samples) result.mean_px += sample.error / static_cast<double>(samples.size());
  const auto p95 = samples.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(samples.size() - 1));
  std::ranges::nth_element(samples, p95, {}, &Sample::error);
  result.p95_px = p95->error;
  const auto worst = std::ranges::max_element(samples, {}, &Sample::error);
  result.max_px = worst->error;
  result.worst = worst->pixel;
  return result;
}

}  // namespace omma
