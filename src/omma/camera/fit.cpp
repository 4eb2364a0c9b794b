// Levenberg and Marquardt's method with numerical derivatives: a lens has at most eighteen parameters, so the normal
// equations are small. For given lens parameters the best focal lengths and principal point follow from two straight
// lines; that is where it starts.
#include "omma/camera/fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/math/cholesky.h"

namespace omma {
namespace {

constexpr double pi = std::numbers::pi;

struct Sample {
  glm::dvec2 pixel;
  glm::dvec3 direction;
};

// From the way the lens looks to a direction, radians.
double angle_from_axis(const Camera& camera, const glm::dvec3& direction) {
  const glm::dvec3 axis = camera.lens() ? -camera.lens()->cameraFromLens[2] : glm::dvec3(0.0, 0.0, -1.0);
  return std::atan2(glm::length(glm::cross(axis, direction)), glm::dot(axis, direction));
}

// Pixels with a ray within that angle of the axis, on a grid over the image, about `side` along the longer side; edges
// and corners included.
std::vector<Sample> samples_of(const Camera& camera, int side, double max_angle) {
  const ImageSize size = camera.size();
  // A ray map holds the rays of pixels' centres; others have them up to the edges.
  const double margin = camera.ray_map() ? 0.5 : 0.0;
  const glm::dvec2 extent(size.width - 2.0 * margin, size.height - 2.0 * margin);
  const double step = std::max(extent.x, extent.y) / side;
  const auto count = [&](double length) { return std::max(2, static_cast<int>(std::ceil(length / step)) + 1); };
  const int columns = count(extent.x), rows = count(extent.y);
  std::vector<Sample> samples;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const glm::dvec2 pixel = margin + extent * glm::dvec2(double(x) / (columns - 1), double(y) / (rows - 1));
      const auto ray = camera.unproject(pixel);
      if (ray && angle_from_axis(camera, ray->direction) <= max_angle) samples.push_back({pixel, ray->direction});
    }
  }
  return samples;
}

class Problem {
 public:
  Problem(const Camera& camera, const LensModel& model, std::vector<size_t> free, std::vector<Sample> samples)
      : model_(model), size_(camera.size()), samples_(std::move(samples)), free_(std::move(free)) {
    if (const Lens* lens = camera.lens()) cameraFromLens_ = lens->cameraFromLens;
    // A ray that is lost costs more than any that lands in the image.
    lost_px_ = std::hypot(size_.width, size_.height);
  }

  /// fx, fy, cx, cy, then the free parameters of the lens.
  using Unknowns = std::vector<double>;

  Lens lens(const Unknowns& unknowns) const {
    Lens lens;
    lens.model = &model_;
    lens.size = size_;
    lens.focal = {unknowns[0], unknowns[1]};
    lens.centre = {unknowns[2], unknowns[3]};
    std::vector<double> values;
    for (const LensParameterInfo& parameter : model_.info.parameters) values.push_back(parameter.default_value);
    for (size_t i = 0; i < free_.size(); ++i) values[free_[i]] = unknowns[4 + i];
    lens.parameters = lens_parameters(model_.info, values);
    lens.cameraFromLens = cameraFromLens_;
    return lens;
  }

  /// Two numbers a sample, pixels; nothing where the unknowns make no lens.
  std::optional<std::vector<double>> residuals(const Unknowns& unknowns) const {
    const auto lens = lens_within_range(unknowns);
    if (!lens) return {};
    std::vector<double> values;
    values.reserve(2 * samples_.size());
    for (const Sample& sample : samples_) {
      const auto pixel = lens->project(sample.direction);
      const glm::dvec2 error = pixel ? *pixel - sample.pixel : glm::dvec2(lost_px_);
      values.push_back(std::clamp(error.x, -lost_px_, lost_px_));
      values.push_back(std::clamp(error.y, -lost_px_, lost_px_));
    }
    return values;
  }

  /// Whether every sample is seen, and nowhere farther off than that.
  bool holds(const Unknowns& unknowns, double tolerance_px) const {
    const Lens lens = this->lens(unknowns);
    return std::ranges::all_of(samples_, [&](const Sample& sample) {
      const auto pixel = lens.project(sample.direction);
      return pixel && glm::distance(*pixel, sample.pixel) <= tolerance_px;
    });
  }

  /// These lens parameters with the focal lengths and the principal point that suit them best; nothing when the lens
  /// sees less than two samples.
  std::optional<Unknowns> start(const std::vector<double>& lens_values) const {
    Unknowns unknowns = {1.0, 1.0, 0.0, 0.0};
    unknowns.insert(unknowns.end(), lens_values.begin(), lens_values.end());
    const auto unit = lens_within_range(unknowns);
    if (!unit) return {};
    double count = 0.0;
    glm::dvec2 plane(0.0), pixel(0.0), plane_plane(0.0), plane_pixel(0.0);
    for (const Sample& sample : samples_) {
      const auto at = unit->project(sample.direction);
      if (!at || glm::length(*at) > 1e3) continue;
      count += 1.0;
      plane += *at;
      pixel += sample.pixel;
      plane_plane += *at * *at;
      plane_pixel += *at * sample.pixel;
    }
    const glm::dvec2 spread = count * plane_plane - plane * plane;
    if (!(count >= 2.0 && spread.x > 0.0 && spread.y > 0.0)) return {};
    const glm::dvec2 focal = (count * plane_pixel - plane * pixel) / spread;
    const glm::dvec2 centre = (pixel - focal * plane) / count;
    std::copy_n(&focal.x, 2, unknowns.begin());
    std::copy_n(&centre.x, 2, unknowns.begin() + 2);
    if (!lens_within_range(unknowns)) return {};
    return unknowns;
  }

  size_t residual_count() const { return 2 * samples_.size(); }
  const std::vector<size_t>& free() const { return free_; }
  const LensModel& model() const { return model_; }

 private:
  std::optional<Lens> lens_within_range(const Unknowns& unknowns) const {
    if (!(unknowns[0] > 1e-3 && unknowns[1] > 1e-3)) return {};
    for (size_t i = 0; i < free_.size(); ++i) {
      const LensParameterInfo& parameter = model_.info.parameters[free_[i]];
      if (!(unknowns[4 + i] >= parameter.min && unknowns[4 + i] <= parameter.max)) return {};
    }
    Lens lens = this->lens(unknowns);
    const bool sees =
        lens.parameters.max_angle > 0.0 && !(model_.info.contradiction && model_.info.contradiction(lens.parameters));
    return sees ? std::optional(std::move(lens)) : std::nullopt;
  }

  const LensModel& model_;
  ImageSize size_;
  glm::dmat3 cameraFromLens_{1.0};  // the other model is turned as the given lens is
  std::vector<Sample> samples_;
  std::vector<size_t> free_;
  double lost_px_;
};

double cost_of(const std::vector<double>& residuals) {
  double cost = 0.0;
  for (const double residual : residuals) cost += residual * residual;
  return cost;
}

// One column for each unknown: how the residuals change with it. Towards the inside where a range ends.
std::vector<std::vector<double>> derivatives(const Problem& problem, const Problem::Unknowns& at,
                                             const std::vector<double>& residuals) {
  std::vector<std::vector<double>> columns(at.size());
  tbb::parallel_for(size_t{0}, at.size(), [&](size_t i) {
    const double step = 1e-6 * std::max(std::abs(at[i]), i < 4 ? 1.0 : 1e-3);
    const auto moved = [&](double by) {
      Problem::Unknowns unknowns = at;
      unknowns[i] += by;
      return problem.residuals(unknowns);
    };
    const auto after = moved(step), before = moved(-step);
    const double distance = (after ? step : 0.0) + (before ? step : 0.0);
    columns[i].assign(residuals.size(), 0.0);
    for (size_t k = 0; k < residuals.size() && distance > 0.0; ++k) {
      columns[i][k] = ((after ? (*after)[k] : residuals[k]) - (before ? (*before)[k] : residuals[k])) / distance;
    }
  });
  return columns;
}

// Below this root mean square nothing is left to gain, in pixels.
constexpr double exact_px = 1e-7;

bool is_exact(double cost, size_t residuals) { return cost <= exact_px * exact_px * static_cast<double>(residuals); }

struct Solution {
  Problem::Unknowns unknowns;
  double cost;
};

Solution minimize(const Problem& problem, Problem::Unknowns unknowns) {
  std::vector<double> residuals = problem.residuals(unknowns).value();
  double cost = cost_of(residuals), damping = 1e-3;
  const size_t n = unknowns.size();
  for (int iteration = 0; iteration < 40 && !is_exact(cost, residuals.size()); ++iteration) {
    const auto columns = derivatives(problem, unknowns, residuals);
    std::vector<double> normal(n * n), gradient(n);
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j <= i; ++j) {
        double sum = 0.0;
        for (size_t k = 0; k < residuals.size(); ++k) sum += columns[i][k] * columns[j][k];
        normal[i * n + j] = normal[j * n + i] = sum;
      }
      for (size_t k = 0; k < residuals.size(); ++k) gradient[i] -= columns[i][k] * residuals[k];
    }
    bool better = false;
    double gain = 0.0;
    while (!better && damping < 1e12) {
      std::vector<double> damped = normal, step = gradient;
      for (size_t i = 0; i < n; ++i) damped[i * n + i] += damping * normal[i * n + i] + 1e-30;
      Problem::Unknowns next = unknowns;
      if (solve_symmetric(damped, step)) {
        for (size_t i = 0; i < n; ++i) next[i] += step[i];
        auto next_residuals = problem.residuals(next);
        const double next_cost = next_residuals ? cost_of(*next_residuals) : cost;
        if (next_cost < cost) {
          better = true;
          gain = (cost - next_cost) / cost;
          unknowns = std::move(next);
          residuals = std::move(*next_residuals);
          cost = next_cost;
        }
      }
      damping = better ? std::max(1e-12, 0.1 * damping) : 10.0 * damping;
    }
    if (!better || gain < 1e-6) break;
  }
  return {std::move(unknowns), cost};
}

// The defaults, and parameters of a narrow range at other places of it, the first two of them together: some lenses
// (omega, xi, alpha) are too far from their defaults for one start, and those with two have valleys with several ends.
std::vector<std::vector<double>> starting_values(const Problem& problem) {
  std::vector<double> defaults;
  std::vector<size_t> narrow;
  for (size_t i = 0; i < problem.free().size(); ++i) {
    const LensParameterInfo& parameter = problem.model().info.parameters[problem.free()[i]];
    defaults.push_back(parameter.default_value);
    if (parameter.max - parameter.min <= 4.0) narrow.push_back(i);
  }
  std::vector<std::vector<double>> starts = {defaults};
  constexpr std::array<double, 5> parts = {0.05, 0.2, 0.4, 0.6, 0.8};
  const auto place = [&](std::vector<double>& values, size_t i, double part) {
    const LensParameterInfo& parameter = problem.model().info.parameters[problem.free()[i]];
    values[i] = parameter.min + part * (parameter.max - parameter.min);
  };
  for (size_t n = 0; n < narrow.size(); ++n) {
    for (const double part : parts) {
      starts.push_back(defaults);
      place(starts.back(), narrow[n], part);
      if (n != 1) continue;
      for (const double other : parts) {
        starts.push_back(starts.back());
        place(starts.back(), narrow[0], other);
      }
    }
  }
  return starts;
}

// The best of descents from the most promising starts, one of them where there is `warm` to start from too.
std::optional<Solution> best_descent(const Problem& problem, const std::optional<Solution>& warm) {
  std::vector<Solution> starts;
  const auto add = [&](Problem::Unknowns unknowns) {
    if (const auto residuals = problem.residuals(unknowns))
      starts.push_back({std::move(unknowns), cost_of(*residuals)});
  };
  for (const std::vector<double>& values : starting_values(problem)) {
    if (auto unknowns = problem.start(values)) add(std::move(*unknowns));
  }
  if (warm) add(warm->unknowns);
  std::ranges::sort(starts, {}, &Solution::cost);
  starts.resize(std::min<size_t>(warm ? 1 : 3, starts.size()));
  std::optional<Solution> best;
  for (const Solution& start : starts) {
    Solution solution = minimize(problem, start.unknowns);
    if (!best || solution.cost < best->cost) best = std::move(solution);
    if (is_exact(best->cost, problem.residual_count())) break;
  }
  return best;
}

std::vector<size_t> free_parameters(const LensModel& model, const std::optional<std::vector<std::string>>& names) {
  std::vector<size_t> free;
  std::vector<std::string> known;
  for (size_t i = 0; i < model.info.parameters.size(); ++i) {
    const LensParameterInfo& parameter = model.info.parameters[i];
    // What is chosen by name has no derivative.
    if (parameter.choices) continue;
    known.emplace_back(parameter.name);
    if (!names || std::ranges::find(*names, parameter.name) != names->end()) free.push_back(i);
  }
  if (names) {
    for (const std::string& name : *names) {
      if (std::ranges::find(known, name) != known.end()) continue;
      throw CommandError("{}", unknown_name(fmt::format("parameter of {}", model.info.name), name, known));
    }
  }
  return free;
}

bool has_only(const Lens& lens, const std::vector<size_t>& free) {
  for (size_t i = 0; i < lens.model->info.parameters.size(); ++i) {
    const LensParameterInfo& parameter = lens.model->info.parameters[i];
    const bool given = parameter.choices || std::ranges::find(free, i) != free.end();
    if (!given && lens.parameters.k[i] != parameter.default_value) return false;
  }
  return true;
}

}  // namespace

Residual residual_between(const Camera& camera, const Camera& other, double max_angle) {
  Residual residual;
  std::vector<double> distances;
  for (const Sample& sample : samples_of(camera, 200, max_angle)) {
    ++residual.points;
    const auto pixel = other.project(sample.direction);
    if (!pixel) {
      ++residual.lost;
      continue;
    }
    const double distance = glm::distance(*pixel, sample.pixel);
    distances.push_back(distance);
    if (distance >= residual.max_px) {
      residual.max_px = distance;
      residual.max_at = sample.pixel;
    }
  }
  if (residual.points == 0) throw InputError("no pixel of the camera has a ray there: there is nothing to compare");
  if (distances.empty()) return residual;
  for (const double distance : distances) residual.mean_px += distance / static_cast<double>(distances.size());
  const auto p95 = distances.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(distances.size() - 1));
  std::ranges::nth_element(distances, p95);
  residual.p95_px = *p95;
  return residual;
}

CameraFit fit_camera(const Camera& camera, const LensModel& model,
                     const std::optional<std::vector<std::string>>& free) {
  const std::vector<size_t> parameters = free_parameters(model, free);
  const Lens* lens = camera.lens();
  if (lens && lens->model == &model && has_only(*lens, parameters)) {
    return {camera, residual_between(camera, camera), lens->parameters.max_angle, 1.0};
  }

  const std::vector<Sample> all = samples_of(camera, 40, pi);
  if (all.empty()) throw InputError("the camera has no ray that a fit could start from");
  double widest = 0.0;
  for (const Sample& sample : all) widest = std::max(widest, angle_from_axis(camera, sample.direction));
  const auto within = [&](double angle) {
    std::vector<Sample> samples;
    std::ranges::copy_if(all, std::back_inserter(samples),
                         [&](const Sample& sample) { return angle_from_axis(camera, sample.direction) <= angle; });
    return Problem(camera, model, parameters, std::move(samples));
  };
  // Beyond this a model does not show what the camera shows there, even if its formula has a value.
  const double tolerance_px = 0.05 * std::hypot(camera.size().width, camera.size().height);

  double angle = widest;
  const Problem whole = within(widest);
  std::optional<Solution> best = best_descent(whole, {});
  if (!best || !whole.holds(best->unknowns, tolerance_px)) {
    // What lies beyond the model's reach must not spoil what it can show: from the middle outwards as far as it holds.
    std::optional<Solution> last;
    for (const double part : {0.2, 0.3, 0.4, 0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95}) {
      const Problem inner = within(part * widest);
      auto solution = inner.residual_count() < 2 * (4 + parameters.size()) ? std::nullopt : best_descent(inner, last);
      if (!solution || !inner.holds(solution->unknowns, tolerance_px)) {
        if (last) break;
        continue;
      }
      last = std::move(solution);
      angle = part * widest;
    }
    if (last) best = std::move(last);
  }
  if (!best) throw CommandError("{}: no camera of this model sees what the given one sees", model.info.name);
  Camera fitted(whole.lens(best->unknowns));
  const double limit = angle < widest ? angle : pi;
  Residual residual = residual_between(camera, fitted, limit);
  const size_t points = samples_of(camera, 200, pi).size();
  return {std::move(fitted), residual, angle, static_cast<double>(residual.points) / static_cast<double>(points)};
}

}  // namespace omma
