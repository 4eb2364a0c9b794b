#include "omma/camera/sampling_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

#include "omma/camera/pieces/piece_set.h"

namespace omma {
namespace {

/// Columns 0 to samples - 1; the row in column i is step * i modulo samples, or step * (i + 1) modulo samples + 1 less
/// one. Both visit each row once.
struct Lattice {
  int64_t step = 1;
  bool one_more = false;  ///< modulo samples + 1
};

int64_t modulus_of(const Lattice& lattice, int64_t samples) { return samples + (lattice.one_more ? 1 : 0); }

std::vector<glm::dvec2> points_of(const Lattice& lattice, int64_t samples) {
  const int64_t modulus = modulus_of(lattice, samples), first = lattice.one_more ? 1 : 0;
  std::vector<glm::dvec2> points;
  points.reserve(size_t(samples));
  for (int64_t column = 0; column < samples; ++column) {
    const int64_t row = lattice.step * (column + first) % modulus - first;
    points.push_back((glm::dvec2(double(column), double(row)) + 0.5) / double(samples) - 0.5);
  }
  return points;
}

/// The integral of the distance from the origin over a rectangle between there and (a, b).
double integral_of_distance(double a, double b) {
  if (a == 0.0 || b == 0.0) return 0.0;
  const double diagonal = std::hypot(a, b);
  return (2.0 * a * b * diagonal + a * a * a * std::log((b + diagonal) / a) +
          b * b * b * std::log((a + diagonal) / b)) /
         6.0;
}

/// But for a constant, the energy distance of the points from the pixel they lie in.
double distance_from_pixel(const std::vector<glm::dvec2>& points) {
  double to_pixel = 0.0, to_each_other = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 low = points[i] + 0.5, high = 0.5 - points[i];
    to_pixel += integral_of_distance(low.x, low.y) + integral_of_distance(low.x, high.y) +
                integral_of_distance(high.x, low.y) + integral_of_distance(high.x, high.y);
    for (size_t k = 0; k < i; ++k) to_each_other += glm::length(points[i] - points[k]);
  }
  const auto count = double(points.size());
  return 2.0 * to_pixel / count - 2.0 * to_each_other / (count * count);
}

/// The squared length of the shortest step between two points of the lattice that goes on for ever (Gauss's reduction).
int64_t shortest_step(const Lattice& lattice, int64_t modulus) {
  using Step = std::pair<int64_t, int64_t>;
  const auto dot = [](const Step& a, const Step& b) { return a.first * b.first + a.second * b.second; };
  Step shorter{1, lattice.step}, longer{0, modulus};
  if (dot(shorter, shorter) > dot(longer, longer)) std::swap(shorter, longer);
  while (true) {
    const int64_t times = std::llround(double(dot(shorter, longer)) / double(dot(shorter, shorter)));
    longer = {longer.first - times * shorter.first, longer.second - times * shorter.second};
    if (dot(longer, longer) >= dot(shorter, shorter)) return dot(shorter, shorter);
    std::swap(shorter, longer);
  }
}

std::vector<Lattice> lattices(int64_t samples) {
  std::vector<Lattice> all;
  for (const bool one_more : {true, false}) {
    const int64_t modulus = samples + (one_more ? 1 : 0);
    for (int64_t step = 1; step < modulus; ++step) {
      if (std::gcd(step, modulus) == 1) all.push_back({step, one_more});
    }
  }
  // The distance from the pixel takes the square of the samples' number to compute. Of many samples only those lattices
  // are compared whose points keep apart.
  constexpr size_t few = 128, kept = 16;
  if (all.size() > few) {
    const auto apart = [&](const Lattice& lattice) { return shortest_step(lattice, modulus_of(lattice, samples)); };
    std::stable_sort(all.begin(), all.end(), [&](const Lattice& a, const Lattice& b) { return apart(a) > apart(b); });
    all.resize(kept);
  }
  return all;
}

std::vector<glm::dvec2> best_pattern(int samples) {
  std::vector<glm::dvec2> best{glm::dvec2(0.0)};
  if (samples < 2) return best;
  double least = std::numeric_limits<double>::infinity();
  for (const Lattice& lattice : lattices(samples)) {
    std::vector<glm::dvec2> points = points_of(lattice, samples);
    const double distance = distance_from_pixel(points);
    if (distance < least) {
      least = distance;
      best = std::move(points);
    }
  }
  // Columns and rows lie symmetrically around the centre, and so they do when they are rounded.
  for (glm::dvec2& point : best) point = glm::round(point * double(piece_grid)) / double(piece_grid);
  return best;
}

}  // namespace

std::vector<glm::dvec2> sampling_pattern(int samples) {
  static std::mutex mutex;
  static std::map<int, std::vector<glm::dvec2>> known;
  const std::lock_guard lock(mutex);
  std::vector<glm::dvec2>& pattern = known[samples];
  if (pattern.empty()) pattern = best_pattern(samples);
  return pattern;
}

}  // namespace omma
