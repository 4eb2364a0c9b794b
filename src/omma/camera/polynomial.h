// Real roots of a polynomial, one interval between turning points at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace omma {

/// c[0] + c[1] x + c[2] x² + …
inline double polynomial_value(std::span<const double> coefficients, double x) {
  double value = 0.0;
  for (size_t i = coefficients.size(); i-- > 0;) value = value * x + coefficients[i];
  return value;
}

/// Where the polynomial crosses zero in (low, high], ascending. Between two roots of its derivative a polynomial only
/// rises or only falls, so each such interval holds at most one crossing and bisection finds it. A point where it
/// touches zero without crossing may be left out.
inline std::vector<double> polynomial_roots(std::span<const double> coefficients, double low, double high) {
  if (coefficients.size() < 2) return {};
  std::vector<double> derivative;
  for (size_t i = 1; i < coefficients.size(); ++i) {
    derivative.push_back(static_cast<double>(i) * coefficients[i]);
  }
  std::vector<double> stops = polynomial_roots(derivative, low, high);
  stops.push_back(high);
  std::vector<double> roots;
  double from = low;
  for (const double to : stops) {
    const bool rises = polynomial_value(coefficients, to) >= 0.0;
    if (rises != (polynomial_value(coefficients, from) >= 0.0)) {
      double before = from, after = to;
      while (true) {
        const double middle = 0.5 * (before + after);
        if (middle <= before || middle >= after) break;
        ((polynomial_value(coefficients, middle) >= 0.0) == rises ? after : before) = middle;
      }
      roots.push_back(rises ? after : before);
    }
    from = to;
  }
  return roots;
}

/// How far p(x) = c[0] x + c[1] x² + … rises on from x = 0: up to `end`, or to where its slope first vanishes; 0 when
/// it does not rise there.
inline double polynomial_rise(std::span<const double> c, double end) {
  if (c.empty() || !(c[0] > 0.0)) return 0.0;
  std::vector<double> slope;
  for (size_t i = 0; i < c.size(); ++i) slope.push_back(static_cast<double>(i + 1) * c[i]);
  const std::vector<double> turns = polynomial_roots(slope, 0.0, end);
  return turns.empty() ? end : turns.front();
}

/// The x up to which p(x) = c[0] x + c[1] x² + … rises without coming above `top`, which is positive; 0 when it does
/// not rise.
inline double polynomial_rise_to(std::span<const double> c, double top) {
  // Cauchy: no root of p(x) - top, nor of its slope, is farther from 0.
  double last = 0.0, largest = top;
  for (const double coefficient : c) {
    if (coefficient != 0.0) last = std::abs(coefficient);
    largest = std::max(largest, std::abs(coefficient));
  }
  const double rise = last > 0.0 ? polynomial_rise(c, std::min(1.0 + largest / last, 1e12)) : 0.0;
  if (!(rise > 0.0)) return 0.0;
  std::vector<double> beyond = {-top};
  beyond.insert(beyond.end(), c.begin(), c.end());
  const std::vector<double> crossings = polynomial_roots(beyond, 0.0, rise);
  return crossings.empty() ? rise : crossings.front();
}

/// c * d, coefficient by coefficient.
inline std::vector<double> polynomial_product(std::span<const double> c, std::span<const double> d) {
  std::vector<double> product(c.size() + d.size() - 1);
  for (size_t i = 0; i < c.size(); ++i) {
    for (size_t j = 0; j < d.size(); ++j) product[i + j] += c[i] * d[j];
  }
  return product;
}

/// How far x top(x²) / bottom(x²) rises on from x = 0, up to 1e6; both begin with 1.
inline double rational_rise(std::span<const double> top, std::span<const double> bottom) {
  // Of y = x²: (top + 2 y top') bottom - 2 y top bottom' vanishes where the slope does.
  std::vector<double> odd_top, double_bottom;
  for (size_t i = 0; i < top.size(); ++i) odd_top.push_back(static_cast<double>(2 * i + 1) * top[i]);
  for (size_t i = 0; i < bottom.size(); ++i) double_bottom.push_back(static_cast<double>(2 * i) * bottom[i]);
  std::vector<double> slope = polynomial_product(odd_top, bottom);
  const std::vector<double> fall = polynomial_product(top, double_bottom);
  for (size_t i = 0; i < slope.size(); ++i) slope[i] -= fall[i];
  double end = 1e12;
  for (const std::span<const double> stop : {std::span<const double>(slope), bottom}) {
    const std::vector<double> roots = polynomial_roots(stop, 0.0, end);
    if (!roots.empty()) end = roots.front();
  }
  return std::sqrt(end);
}

}  // namespace omma
