#include "omma/technique/nonlinear/lens_curvature.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <mutex>

namespace omma {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr Curvature unknown{infinite, infinite, 0.0f};
/// On what is measured at a few points; between them and the cell's own spread the neighbours' values stand in too.
constexpr double safety = 1.25;

struct Cell {
  int face = 0;
  glm::dvec2 place{0.0};  ///< on the face, -1 to 1; beyond that, on its plane
};

/// As in shaders/technique/nonlinear/outline.glsl.
Cell cell_of(const glm::dvec3& d) {
  const glm::dvec3 size = glm::abs(d);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return {2 * axis + (d[axis] < 0.0), glm::dvec2(d[(axis + 1) % 3], d[(axis + 2) % 3]) / size[axis]};
}

glm::dvec3 direction_of(const Cell& cell) {
  const int axis = cell.face / 2;
  glm::dvec3 d;
  d[axis] = cell.face % 2 == 0 ? 1.0 : -1.0;
  d[(axis + 1) % 3] = cell.place.x;
  d[(axis + 2) % 3] = cell.place.y;
  return glm::normalize(d);
}

size_t index_of(const Cell& cell, int cells) {
  const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor((cell.place + 1.0) * (0.5 * cells))), 0, cells - 1);
  return (size_t(cell.face) * size_t(cells) + size_t(at.y)) * size_t(cells) + size_t(at.x);
}

Curvature worse(const Curvature& a, const Curvature& b) {
  return {std::max(a.bend, b.bend), std::max(a.change, b.change), std::min(a.speed, b.speed)};
}

/// A lens's derivatives at a point, by differences along four great circles.
class Probe {
 public:
  Probe(const Lens& lens, const glm::dvec3& centre) : lens_(lens), centre_(centre) {}

  Curvature measure() {
    const auto middle = lens_.project(centre_);
    if (!middle) return unknown;
    const glm::dvec3 side = std::abs(centre_.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(centre_, side)), v = glm::cross(centre_, u);
    std::array<glm::dvec2, 4> first, second;
    for (int i = 0; i < 4; ++i) {
      const double turn = i * glm::quarter_pi<double>();
      if (!differences(*middle, std::cos(turn) * u + std::sin(turn) * v, first[size_t(i)], second[size_t(i)])) {
        return unknown;
      }
    }
    // p'' is a quadratic form of the direction: a constant and what turns with twice its angle.
    const glm::dvec2 constant = 0.5 * (second[0] + second[2]), cosine = 0.5 * (second[0] - second[2]),
                     sine = 0.5 * (second[1] - second[3]);
    Curvature result{0.0f, 0.0f, infinite};
    constexpr int turns = 24;
    for (int i = 0; i < turns; ++i) {
      const double turn = glm::pi<double>() * i / turns;
      const glm::dvec2 p1 = std::cos(turn) * first[0] + std::sin(turn) * first[2];
      const glm::dvec2 p2 = constant + std::cos(2.0 * turn) * cosine + std::sin(2.0 * turn) * sine;
      const double speed = glm::length(p1);
      const double across = speed > 0.0 ? std::abs(p1.x * p2.y - p1.y * p2.x) / speed : glm::length(p2);
      result = worse(result, {float(safety * across), float(safety * glm::length(p2)), float(speed / safety)});
    }
    return result;
  }

 private:
  /// Far enough for a fold anywhere in a cell to lie under one of its points' differences.
  static constexpr double step = 1.5 / LensCurvature::cells_a_side;

  bool differences(const glm::dvec2& middle, const glm::dvec3& along, glm::dvec2& first, glm::dvec2& second) const {
    glm::dvec2 coarse, fine;
    if (!difference(middle, along, step, first, coarse) || !difference(middle, along, 0.5 * step, first, fine)) {
      return false;
    }
    // Where the lens has a jump or a fold the differences depend on the step.
    const double off = glm::distance(coarse, fine), most = std::max(glm::length(coarse), glm::length(fine));
    second = glm::length(coarse) > glm::length(fine) ? coarse : fine;
    return off <= 0.3 * most || off * step * step < 0.01;
  }

  bool difference(const glm::dvec2& middle, const glm::dvec3& along, double angle, glm::dvec2& first,
                  glm::dvec2& second) const {
    const auto before = lens_.project(std::cos(angle) * centre_ - std::sin(angle) * along);
    const auto after = lens_.project(std::cos(angle) * centre_ + std::sin(angle) * along);
    if (!before || !after) return false;
    first = (*after - *before) / (2.0 * angle);
    second = (*after - 2.0 * middle + *before) / (angle * angle);
    return std::isfinite(glm::dot(first, first) + glm::dot(second, second));
  }

  const Lens& lens_;
  glm::dvec3 centre_;
};

/// What lies within each cell, measured at its centre and corners.
std::vector<Curvature> measured(const Lens& lens) {
  constexpr int cells = LensCurvature::cells_a_side;
  std::vector<Curvature> table(6 * cells * cells);
  tbb::parallel_for(0, 6 * cells, [&](int row) {
    for (int x = 0; x < cells; ++x) {
      const int face = row / cells, y = row % cells;
      Curvature cell{0.0f, 0.0f, infinite};
      constexpr glm::dvec2 points[] = {{0.5, 0.5}, {0, 0}, {1, 0}, {0, 1}, {1, 1}};
      for (const glm::dvec2& point : points) {
        const glm::dvec2 place = (glm::dvec2(x, y) + point) * (2.0 / cells) - 1.0;
        cell = worse(cell, Probe(lens, direction_of({face, place})).measure());
        if (cell.change == infinite) break;
      }
      table[size_t(row) * cells + size_t(x)] = cell;
    }
  });
  return table;
}

void mark(const Lens& lens, const glm::dvec2& pixel, std::vector<Curvature>& table, std::mutex& marking) {
  const auto ray = lens.unproject(pixel);
  if (!ray) return;
  const auto found = lens.project(*ray);
  if (found && glm::distance(*found, pixel) < 0.25) return;
  const std::lock_guard lock(marking);
  table[index_of(cell_of(*ray), LensCurvature::cells_a_side)] = unknown;
}

/// A lens may show a direction in two places of its image, most likely at its borders; `project` knows one of them.
void mark_what_project_misses(const Lens& lens, std::vector<Curvature>& table) {
  const ImageSize size = lens.size;
  const int inner_step = lens.model->info.parts != nullptr ? 1 : 4;
  std::mutex marking;
  tbb::parallel_for(0, size.height, [&](int y) {
    const bool border_row = y == 0 || y == size.height - 1;
    if (!border_row && y % inner_step != 0) {
      if (size.width > 1) mark(lens, {size.width - 0.5, y + 0.5}, table, marking);
      return mark(lens, {0.5, y + 0.5}, table, marking);
    }
    const int step = border_row ? 1 : inner_step;
    for (int x = 0; x < size.width; x += step) mark(lens, {x + 0.5, y + 0.5}, table, marking);
    mark(lens, {size.width - 0.5, y + 0.5}, table, marking);
  });
}

/// A circle around a cell's directions.
struct CellCircle {
  glm::dvec3 centre;
  double angle;
};

std::vector<CellCircle> cell_circles() {
  constexpr int cells = LensCurvature::cells_a_side;
  std::vector<CellCircle> circles;
  for (int i = 0; i < 6 * cells * cells; ++i) {
    const int face = i / (cells * cells);
    const auto at = [&](double x, double y) {
      return direction_of({face, (glm::dvec2(i % cells + x, i / cells % cells + y)) * (2.0 / cells) - 1.0});
    };
    const glm::dvec3 centre = at(0.5, 0.5);
    const double cosine = std::min({glm::dot(centre, at(0, 0)), glm::dot(centre, at(1, 0)), glm::dot(centre, at(0, 1)),
                                    glm::dot(centre, at(1, 1))});
    circles.push_back({centre, std::acos(cosine)});
  }
  return circles;
}

/// Each cell's bounds and those of all cells within reach of any of its directions.
std::vector<Curvature> within_reach(const std::vector<Curvature>& table, double reach) {
  static const std::vector<CellCircle> circles = cell_circles();
  std::vector<Curvature> result(table.size(), {0.0f, 0.0f, infinite});
  tbb::parallel_for(size_t(0), table.size(), [&](size_t i) {
    const double far = reach + circles[i].angle, cosine = std::cos(far), sine = std::sin(far);
    for (size_t j = 0; j < table.size(); ++j) {
      // The cosine of the sum of both angles, the other one small.
      const double most = cosine * (1.0 - 0.5 * circles[j].angle * circles[j].angle) - sine * circles[j].angle;
      if (glm::dot(circles[i].centre, circles[j].centre) >= most) result[i] = worse(result[i], table[j]);
    }
  });
  return result;
}

}  // namespace

float Curvature::deviation_px(float angle) const {
  return change == infinite ? infinite : (bend + change * std::min(1.0f, turn(angle))) * angle * angle / 8.0f;
}

LensCurvature::LensCurvature(const Lens& lens) {
  std::vector<Curvature> table = measured(without_limit(lens));
  mark_what_project_misses(lens, table);
  for (int level = 0; level < levels; ++level) {
    const std::vector<Curvature> wide = within_reach(table, reach(level));
    cells_.insert(cells_.end(), wide.begin(), wide.end());
  }
}

Lens LensCurvature::without_limit(Lens lens) {
  lens.parameters.max_angle = lens.model->info.max_angle(lens.parameters);
  return lens;
}

Curvature LensCurvature::around(const glm::dvec3& direction, double angle) const {
  for (int level = 0; level < levels; ++level) {
    if (angle > reach(level)) continue;
    return cells_[size_t(level) * 6 * cells_a_side * cells_a_side + index_of(cell_of(direction), cells_a_side)];
  }
  return unknown;
}

}  // namespace omma
