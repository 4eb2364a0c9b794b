// Radial cameras measured as a table of angles and radii.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "omma/base/error.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/camera/deformation/radial_camera.h"
#include "omma/camera/deformation/text_rows.h"

namespace omma {
namespace {

// Cubic between points that rise, without a swing that would turn back between them: Fritsch and Butland, "A method for
// constructing local monotone piecewise cubic interpolants", SIAM Journal on Scientific Computing 5(2), 1984.
class MonotoneCubic {
 public:
  MonotoneCubic(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)), slope_(x_.size()) {
    const size_t last = x_.size() - 1;
    const auto rise = [&](size_t i) { return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]); };
    for (size_t i = 1; i < last; ++i) {
      const double left = x_[i] - x_[i - 1], right = x_[i + 1] - x_[i];
      // A weighted harmonic mean, the longer side's slope counting less.
      slope_[i] = 3.0 * (left + right) / ((2.0 * right + left) / rise(i - 1) + (right + 2.0 * left) / rise(i));
    }
    // At the ends the slope of the parabola through three points, kept within what stays monotone.
    const auto end_slope = [&](size_t i, size_t next, size_t step_i, size_t step_next) {
      if (last == 1) return rise(0);
      const double near = std::abs(x_[next] - x_[i]), far = std::abs(x_[step_next + 1] - x_[step_next]);
      const double slope = ((2.0 * near + far) * rise(step_i) - near * rise(step_next)) / (near + far);
      return std::clamp(slope, 0.0, 3.0 * rise(step_i));
    };
    slope_[0] = end_slope(0, 1, 0, 1);
    slope_[last] = end_slope(last, last - 1, last - 1, last - 2);
  }

  double operator()(double x) const {
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
    const size_t i = static_cast<size_t>(above - x_.begin()) - 1;
    const double width = x_[i + 1] - x_[i], t = (x - x_[i]) / width, s = 1.0 - t;
    return y_[i] * s * s * (1.0 + 2.0 * t) + y_[i + 1] * t * t * (1.0 + 2.0 * s) +
           width * t * s * (slope_[i] * s - slope_[i + 1] * t);
  }

 private:
  std::vector<double> x_, y_, slope_;
};

struct Table {
  std::vector<double> angles, radii;  ///< radians, the file's unit
};

Table read_table(const std::string& path, bool angle_first, const Limits& limits) {
  constexpr size_t max_rows = 1'000'000;
  Table table;
  for_each_row(path, limits, [&](const TextRow& row) {
    if (row.words.size() != 2) {
      throw InputError("{}: {} values; two are expected, the angle in degrees and the radius", row.place,
                       row.words.size());
    }
    const double angle = row.number(angle_first ? 0 : 1), radius = row.number(angle_first ? 1 : 0);
    if (!(angle >= 0.0 && angle <= 180.0 && radius >= 0.0)) {
      throw InputError("{}: angle {}, radius {}; 0 to 180 degrees and no negative radius are accepted", row.place,
                       angle, radius);
    }
    const double radians = angle * std::numbers::pi / 180.0;
    if (!table.angles.empty() && !(radians > table.angles.back() && radius > table.radii.back())) {
      throw InputError("{}: angle {} and radius {} have to be larger than those of the row before", row.place, angle,
                       radius);
    }
    if (table.angles.size() == max_rows) throw InputError("{}: more than {} rows", row.place, max_rows);
    table.angles.push_back(radians);
    table.radii.push_back(radius);
  });
  if (table.angles.size() < 2) {
    throw InputError("{}: {} rows; two or more of 'angle radius' are expected", path, table.angles.size());
  }
  return table;
}

}  // namespace

Camera make_table_camera(const Spec& spec, std::optional<ImageSize> size, const Limits& limits) {
  const DeformationText text(spec, limits);
  std::vector<const char*> keys = {"file", "columns"};
  keys.insert(keys.end(), radial_keys.begin(), radial_keys.end());
  text.accept_only(keys);
  const std::vector<std::string> orders = {"theta_r", "r_theta"};
  const std::string order = text.has("columns") ? text.value("columns") : orders.front();
  if (std::ranges::find(orders, order) == orders.end()) {
    throw CommandError("{}: {}", spec.name, unknown_name("columns", order, orders));
  }
  const bool angle_first = order == orders.front();
  Table table = read_table(text.value("file"), angle_first, limits);
  std::vector<double> x = table.angles, y = table.radii;
  if (!angle_first) std::swap(x, y);
  const double low = x.front(), high = x.back();
  return make_radial_camera(text, {RisingFunction(MonotoneCubic(std::move(x), std::move(y)), low, high), angle_first},
                            size);
}

}  // namespace omma
