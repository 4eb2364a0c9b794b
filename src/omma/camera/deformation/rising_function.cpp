#include "omma/camera/deformation/rising_function.h"

#include <algorithm>
#include <cmath>

namespace omma {

RisingFunction::RisingFunction(std::function<double(double)> function, double low, double high)
    : function_(std::move(function)) {
  constexpr int steps = 4096;
  x_.push_back(low);
  y_.push_back(function_(low));
  for (int i = 1; i <= steps && std::isfinite(y_.front()); ++i) {
    const double x = i == steps ? high : low + (high - low) * i / steps;
    const double y = function_(x);
    if (!(std::isfinite(y) && y > y_.back())) {
      end_between(x_.size() > 1 ? x_[x_.size() - 2] : low, x);
      break;
    }
    x_.push_back(x);
    y_.push_back(y);
  }
}

// Golden section search for the highest place, where what is undefined is lower than anything.
void RisingFunction::end_between(double seen, double beyond) {
  const auto height = [&](double x) {
    const double y = function_(x);
    return std::isfinite(y) ? y : -std::numeric_limits<double>::infinity();
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = seen, b = beyond;
  double left = b - golden * (b - a), right = a + golden * (b - a);
  double left_height = height(left), right_height = height(right);
  for (int i = 0; i < 80; ++i) {
    // Equal: level ground, or both undefined; the function ends before either.
    if (left_height < right_height) {
      a = left;
      left = right;
      left_height = right_height;
      right = a + golden * (b - a);
      right_height = height(right);
    } else {
      b = right;
      right = left;
      right_height = left_height;
      left = b - golden * (b - a);
      left_height = height(left);
    }
  }
  const double x = left_height < right_height ? right : left;
  const double y = std::max(left_height, right_height);
  while (x_.size() > 1 && x_.back() >= x) {
    x_.pop_back();
    y_.pop_back();
  }
  if (x > x_.back() && y > y_.back()) {
    x_.push_back(x);
    y_.push_back(y);
  }
}

std::optional<double> RisingFunction::operator()(double x) const {
  if (!(x >= low() && x <= end())) return {};
  const double y = function_(x);
  if (!std::isfinite(y)) return {};
  return y;
}

std::optional<double> RisingFunction::inverse(double y) const {
  if (!(y >= low_value() && y <= end_value())) return {};
  const auto above = std::upper_bound(y_.begin(), y_.end(), y);
  if (above == y_.end()) return end();
  const size_t i = static_cast<size_t>(above - y_.begin());
  double a = x_[i - 1], b = x_[i], a_miss = y_[i - 1] - y, b_miss = y_[i] - y;
  // False position, and bisection whenever that has not halved the interval: fast, and it always ends.
  bool bisect = false;
  while (a_miss != 0.0) {
    double x = bisect ? 0.5 * (a + b) : a - a_miss * (b - a) / (b_miss - a_miss);
    if (!(x > a && x < b)) x = 0.5 * (a + b);
    if (x <= a || x >= b) break;
    const double width = b - a, miss = function_(x) - y;
    if (!(std::abs(miss) > 1e-16 * std::abs(y))) {
      a = x;
      a_miss = miss;
      break;
    }
    (miss < 0.0 ? a : b) = x;
    (miss < 0.0 ? a_miss : b_miss) = miss;
    bisect = b - a > 0.5 * width;
  }
  const double x = std::abs(a_miss) <= std::abs(b_miss) ? a : b;
  const double miss = std::min(std::abs(a_miss), std::abs(b_miss));
  if (!(miss <= 1e-6 * std::max(1e-3, std::abs(y)))) return {};
  return x;
}

}  // namespace omma
