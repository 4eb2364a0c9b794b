// Levenberg and Marquardt's method with numerical derivatives: a lens has at most eighteen parameters, so the normal
// equations are small. For given lens parameters the best focal lengths and principal point follow from two straight
// lines; that is where it starts.
#include "omma/camera/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {
namespace {

struct Sample {
  glm::dvec2 pixel;
  glm::dvec3 direction;
};

// Pixels with a ray on a grid over the image, about `side` along the longer side; edges and corners included.
std::vector<Sample> samples_of(const Camera& camera, int side) {
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
      if (const auto ray = camera.unproject(pixel)) samples.push_back({pixel, ray->direction});
    }
  }
  return samples;
}

class Problem {
 public:
  Problem(const Camera& camera, const LensModel& model, std::vector<size_t> free)
      : model_(model), size_(camera.size()), samples_(samples_of(camera, 40)), free_(std::move(free)) {
    if (const Lens* lens = camera.lens()) cameraFromLens_ = lens->cameraFromLens;
    if (samples_.empty()) throw InputError("the camera has no ray that a fit could start from");
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

  bool within_range(const Unknowns& unknowns) const {
    if (!(unknowns[0] > 1e-3 && unknowns[1] > 1e-3)) return false;
    for (size_t i = 0; i < free_.size(); ++i) {
      const LensParameterInfo& parameter = model_.info.parameters[free_[i]];
      if (!(unknowns[4 + i] >= parameter.min && unknowns[4 + i] <= parameter.max)) return false;
    }
    const Lens lens = this->lens(unknowns);
    return lens.parameters.max_angle > 0.0 &&
           !(model_.info.contradiction && model_.info.contradiction(lens.parameters));
  }

  /// Two numbers a sample, pixels.
  std::vector<double> residuals(const Unknowns& unknowns) const {
    const Lens lens = this->lens(unknowns);
    std::vector<double> values;
    values.reserve(2 * samples_.size());
    for (const Sample& sample : samples_) {
      const auto pixel = lens.project(sample.direction);
      const glm::dvec2 error = pixel ? *pixel - sample.pixel : glm::dvec2(lost_px_);
      values.push_back(std::clamp(error.x, -lost_px_, lost_px_));
      values.push_back(std::clamp(error.y, -lost_px_, lost_px_));
    }
    return values;
  }

  /// These lens parameters with the focal lengths and the principal point that suit them best; nothing when the lens
  /// sees less than two samples.
  std::optional<Unknowns> start(const std::vector<double>& lens_values) const {
    Unknowns unknowns = {1.0, 1.0, 0.0, 0.0};
    unknowns.insert(unknowns.end(), lens_values.begin(), lens_values.end());
    if (!within_range(unknowns)) return {};
    const Lens unit = lens(unknowns);
    double count = 0.0;
    glm::dvec2 plane(0.0), pixel(0.0), plane_plane(0.0), plane_pixel(0.0);
    for (const Sample& sample : samples_) {
      const auto at = unit.project(sample.direction);
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
    if (!within_range(unknowns)) return {};
    return unknowns;
  }

  size_t residual_count() const { return 2 * samples_.size(); }
  const std::vector<size_t>& free() const { return free_; }
  const LensModel& model() const { return model_; }

 private:
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

// A symmetric positive definite system by Cholesky's method; false when it is not definite.
bool solve(std::vector<double> a, std::vector<double>& b) {
  const size_t n = b.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      if (i == j && !(sum > 0.0)) return false;
      a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
    }
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
  return true;
}

// One column for each unknown: how the residuals change with it. Towards the inside where a range ends.
std::vector<std::vector<double>> derivatives(const Problem& problem, const Problem::Unknowns& at) {
  std::vector<std::vector<double>> columns;
  for (size_t i = 0; i < at.size(); ++i) {
    Problem::Unknowns before = at, after = at;
    const double step = 1e-6 * std::max(std::abs(at[i]), i < 4 ? 1.0 : 1e-3);
    after[i] += step;
    before[i] -= step;
    if (!problem.within_range(after)) after = at;
    if (!problem.within_range(before)) before = at;
    const double distance = after[i] - before[i];
    std::vector<double> high = problem.residuals(after);
    const std::vector<double> low = problem.residuals(before);
    for (size_t k = 0; k < high.size(); ++k) high[k] = distance > 0.0 ? (high[k] - low[k]) / distance : 0.0;
    columns.push_back(std::move(high));
  }
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
  std::vector<double> residuals = problem.residuals(unknowns);
  double cost = cost_of(residuals), damping = 1e-3;
  const size_t n = unknowns.size();
  for (int iteration = 0; iteration < 80 && !is_exact(cost, residuals.size()); ++iteration) {
    const auto columns = derivatives(problem, unknowns);
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
      if (solve(damped, step)) {
        for (size_t i = 0; i < n; ++i) next[i] += step[i];
        if (problem.within_range(next)) {
          std::vector<double> next_residuals = problem.residuals(next);
          const double next_cost = cost_of(next_residuals);
          if (next_cost < cost) {
            better = true;
            gain = (cost - next_cost) / cost;
            unknowns = std::move(next);
            residuals = std::move(next_residuals);
            cost = next_cost;
          }
        }
      }
      damping = better ? std::max(1e-12, 0.1 * damping) : 10.0 * damping;
    }
    if (!better || gain < 1e-8) break;
  }
  return {std::move(unknowns), cost};
}

// The defaults, and each parameter of a narrow range in turn at other places of it: some lenses (omega, xi, alpha) are
// too far from their defaults for one start.
std::vector<std::vector<double>> starting_values(const Problem& problem) {
  std::vector<double> defaults;
  for (const size_t i : problem.free()) defaults.push_back(problem.model().info.parameters[i].default_value);
  std::vector<std::vector<double>> starts = {defaults};
  for (size_t i = 0; i < defaults.size(); ++i) {
    const LensParameterInfo& parameter = problem.model().info.parameters[problem.free()[i]];
    if (parameter.max - parameter.min > 4.0) continue;
    for (const double part : {0.05, 0.2, 0.4, 0.6, 0.8}) {
      starts.push_back(defaults);
      starts.back()[i] = parameter.min + part * (parameter.max - parameter.min);
    }
  }
  return starts;
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

Residual residual_between(const Camera& camera, const Camera& other) {
  Residual residual;
  std::vector<double> distances;
  for (const Sample& sample : samples_of(camera, 200)) {
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
  if (residual.points == 0) throw InputError("no pixel of the camera has a ray: there is nothing to compare");
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
  if (lens && lens->model == &model && has_only(*lens, parameters)) return {camera, residual_between(camera, camera)};

  const Problem problem(camera, model, parameters);
  std::vector<Solution> starts;
  for (const std::vector<double>& values : starting_values(problem)) {
    if (auto unknowns = problem.start(values)) {
      const double cost = cost_of(problem.residuals(*unknowns));
      starts.push_back({std::move(*unknowns), cost});
    }
  }
  if (starts.empty()) {
    throw CommandError("{}: no camera of this model sees what the given one sees", model.info.name);
  }
  std::ranges::sort(starts, {}, &Solution::cost);
  std::optional<Solution> best;
  for (size_t i = 0; i < std::min<size_t>(3, starts.size()); ++i) {
    Solution solution = minimize(problem, starts[i].unknowns);
    if (!best || solution.cost < best->cost) best = std::move(solution);
    if (is_exact(best->cost, problem.residual_count())) break;
  }
  Camera fitted(problem.lens(best->unknowns));
  Residual residual = residual_between(camera, fitted);
  return {std::move(fitted), residual};
}

}  // namespace omma
