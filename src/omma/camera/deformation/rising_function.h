// A function of one number as far as it rises, and the way back.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace omma {

/// What a radial camera's r(θ) or θ(r) has to be. A calibrated lens has an honest edge: it ends where its formula turns
/// back or is no longer defined.
class RisingFunction {
 public:
  /// Follows `function` from `low` in steps of 1/4096 of the way to `high`, up to where it falls, stays level or is not
  /// finite; that place is then found as closely as numbers go.
  RisingFunction(std::function<double(double)> function, double low, double high);

  double low() const { return x_.front(); }
  /// Equal to low() when the function does not rise at all.
  double end() const { return x_.back(); }
  double low_value() const { return y_.front(); }
  double end_value() const { return y_.back(); }

  /// Nothing outside low() to end().
  std::optional<double> operator()(double x) const;
  /// The x of this value. Nothing for values that are not reached, those that a jump passes over included.
  std::optional<double> inverse(double y) const;

 private:
  void end_between(double seen, double beyond);

  std::function<double(double)> function_;
  std::vector<double> x_, y_;  // both ascending
};

}  // namespace omma
