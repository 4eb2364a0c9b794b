// Benchmarks: each prints a table of medians, their spread, and ratios to a baseline measured in the same run.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace omma::bench {

struct Options {
  int runs = 9;       ///< of each configuration, after one that warms up
  std::string scene;  ///< one more to measure in, of benchmarks that take one; empty: none
};

struct Benchmark {
  const char* name;
  const char* description;
  /// Prints its tables as Markdown and returns the same numbers.
  nlohmann::json (*run)(const Options& options);
  bool takes_scene = false;
};

/// The only list of benchmarks.
std::span<const Benchmark> benchmarks();

/// Of one configuration, in milliseconds.
struct Timing {
  double median = 0.0, low = 0.0, high = 0.0;  ///< low and high: 10th and 90th percentile
};

/// Of one configuration's milliseconds.
Timing timing_of(std::vector<double> times);

/// Milliseconds of every configuration in every run: once to warm up, uncounted, then all of them in turn.
std::vector<std::vector<double>> times_in_turn(std::span<const std::function<double()>> configurations, int runs);

/// Runs every configuration once to warm up, then all of them in turn, `runs` times: what disturbs the machine for a
/// while disturbs them alike. A configuration returns its milliseconds.
std::vector<Timing> measure_in_turn(std::span<const std::function<double()>> configurations, int runs);

/// Of two configurations' times, run by run, so that what disturbs both does not disturb it.
Timing ratio_of(const std::vector<double>& times, const std::vector<double>& baseline, double scale = 1.0);

/// "1.23 (1.19–1.40)"
std::string ratio_text(const Timing& ratio);
/// "12.3 (11.9–14.0)"
std::string to_text(const Timing& timing);
nlohmann::json to_json(const Timing& timing);

}  // namespace omma::bench
