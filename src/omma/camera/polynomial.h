// Real roots of a polynomial, one interval between turning points at a time.
#pragma once

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

}  // namespace omma
