#include "bench/bench.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bench/changing_camera.h"
#include "bench/effects.h"
#include "bench/image_based.h"
#include "bench/nonlinear.h"
#include "bench/piecewise.h"
#include "bench/subdivision.h"
#include "bench/visibility.h"

namespace omma::bench {
namespace {

constexpr Benchmark list[] = {
    {"image-based", "the cube map's variants and the exact oracle against a planar picture of the same scene and size",
     run_image_based},
    {"piecewise", "perspective pieces against the cube map and a planar picture; growth with pieces and triangles",
     run_piecewise},
    {"visibility",
     "the tree of rays that finds the visible triangles against Embree; growth with triangles; whole frames against "
     "every other technique",
     run_visibility, true},
    {"changing-camera", "frames whose lens is another one each time against one that stands still; the cube map beside",
     run_changing_camera, true},
    {"nonlinear", "bounding shapes and hybrid against cubes, hemicubes and a planar picture; where the time goes",
     run_nonlinear},
    {"subdivision", "triangles split, bounded, or projected by their vertices alone, against planar and the cube map",
     run_subdivision},
    {"effects", "how evenly lines and strokes come out over the image, by technique", run_effects},
};

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[size_t(std::lround(share * double(sorted.size() - 1)))];
}

}  // namespace

std::span<const Benchmark> benchmarks() { return list; }

Timing timing_of(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return {percentile(times, 0.5), percentile(times, 0.1), percentile(times, 0.9)};
}

std::vector<std::vector<double>> times_in_turn(std::span<const std::function<double()>> configurations, int runs) {
  std::vector<std::vector<double>> times(configurations.size());
  for (const auto& configuration : configurations) configuration();
  for (int run = 0; run < runs; ++run) {
    for (size_t i = 0; i < configurations.size(); ++i) times[i].push_back(configurations[i]());
  }
  return times;
}

std::vector<Timing> measure_in_turn(std::span<const std::function<double()>> configurations, int runs) {
  std::vector<Timing> timings;
  for (std::vector<double>& times : times_in_turn(configurations, runs)) timings.push_back(timing_of(std::move(times)));
  return timings;
}

Timing ratio_of(const std::vector<double>& times, const std::vector<double>& baseline, double scale) {
  std::vector<double> ratios;
  for (size_t i = 0; i < times.size(); ++i) ratios.push_back(scale * times[i] / baseline[i]);
  return timing_of(std::move(ratios));
}

std::string ratio_text(const Timing& ratio) {
  return fmt::format("{:.2f} ({:.2f}–{:.2f})", ratio.median, ratio.low, ratio.high);
}

std::string to_text(const Timing& timing) {
  return fmt::format("{:.1f} ({:.1f}–{:.1f})", timing.median, timing.low, timing.high);
}

nlohmann::json to_json(const Timing& timing) {
  return {{"median_ms", timing.median}, {"p10_ms", timing.low}, {"p90_ms", timing.high}};
}

}  // namespace omma::bench
