// omma compare: how far apart two images are, and whether that is too far.
#include "omma/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "arguments.h"
#include "commands.h"
#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/image/read.h"
#include "omma/image/shift.h"
#include "omma/image/write.h"
#include "reading.h"

namespace omma::tool {
namespace {

/// Two images and how they differ. The shift takes longer than all else: it is measured where it is asked for.
struct Comparison {
  Difference difference;
  std::optional<glm::dvec2> shift;
};

struct Metric {
  const char* name;
  const char* json_name;
  const char* unit;
  std::optional<double> (*value)(const Comparison&);
  const char* limit_option;
  bool limit_is_minimum;
  const char* limit_description;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::string_view shift_name = "shift";

constexpr Metric metrics[] = {
    {"psnr", "psnr_db", " dB", [](const Comparison& c) { return c.difference.psnr; }, "--min-psnr", true,
     "Fail below this peak signal-to-noise ratio in dB"},
    {"ssim", "ssim", "", [](const Comparison& c) { return c.difference.ssim; }, "--min-ssim", true,
     "Fail below this structural similarity"},
    {"max", "max", "", [](const Comparison& c) { return c.difference.max; }, "--max-max", false,
     "Fail when a component of a pixel differs by more"},
    {"mean", "mean", "", [](const Comparison& c) { return c.difference.mean; }, "--max-mean", false,
     "Fail when the components differ by more on average"},
    {"id", "id_share", " of the pixels", [](const Comparison& c) { return std::optional(c.difference.mismatch_share); },
     "--max-id-share", false,
     "Fail when a larger share of pixels (0 to 1) has different numbers, or a value in one image only"},
    {"shift", "shift_px", " px",
     [](const Comparison& c) { return c.shift ? std::optional(glm::length(*c.shift)) : std::nullopt; }, "--max-shift",
     false, "Fail when B is moved against A by more pixels"},
};
constexpr size_t metric_count = std::size(metrics);

/// As typed.
struct Options {
  std::string a, b;
  Text metric, diff;
  std::array<Text, metric_count> limits;
  ReadingOptions reading;
  bool json = false, raw = false;
};

std::vector<const Metric*> metrics_of(const Options& options, const Comparison& comparison) {
  std::vector<const Metric*> chosen;
  if (!options.metric) {
    for (const Metric& metric : metrics) {
      if (metric.value(comparison)) chosen.push_back(&metric);
    }
    return chosen;
  }
  for (const std::string& name : split(*options.metric, ',')) {
    const auto found =
        std::find_if(std::begin(metrics), std::end(metrics), [&](const Metric& metric) { return metric.name == name; });
    if (!found->value(comparison)) {
      throw CommandError(
          "--metric {}: these images have none; numbers have id, ssim needs 11 x 11 pixels or more, shift something to "
          "be seen that has edges in two directions",
          name);
    }
    chosen.push_back(found);
  }
  return chosen;
}

bool wants_shift(const Options& options) {
  const auto limit = std::find_if(std::begin(metrics), std::end(metrics),
                                  [](const Metric& metric) { return metric.name == shift_name; });
  if (options.limits[size_t(limit - std::begin(metrics))]) return true;
  if (!options.metric) return false;
  const std::vector<std::string> names = split(*options.metric, ',');
  return std::find(names.begin(), names.end(), shift_name) != names.end();
}

void check_metric_names(const Options& options) {
  if (!options.metric) return;
  std::vector<std::string> names;
  for (const Metric& metric : metrics) names.emplace_back(metric.name);
  for (const std::string& name : split(*options.metric, ',')) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw CommandError("--metric: {}", unknown_name("metric", name, names));
    }
  }
  if (options.metric->empty()) throw CommandError("--metric names none of: {}", fmt::join(names, ", "));
}

std::array<std::optional<double>, metric_count> limits_of(const Options& options) {
  std::array<std::optional<double>, metric_count> limits;
  for (size_t i = 0; i < metric_count; ++i) {
    if (options.limits[i]) limits[i] = number_of(metrics[i].limit_option, *options.limits[i], -1.0, infinity);
  }
  return limits;
}

/// 8-bit colour is compared as a screen shows it, measured numbers as they are.
Scale scale_of(const Options& options) {
  const auto is_display = [](const std::string& path) {
    return path.ends_with(".png") || path.ends_with(".jpg") || path.ends_with(".jpeg");
  };
  return !options.raw && (is_display(options.a) || is_display(options.b)) ? Scale::display : Scale::raw;
}

void print_text(const std::vector<const Metric*>& chosen, const Comparison& comparison) {
  for (const Metric* metric : chosen) {
    fmt::print("{:<6}{:.6g}{}", metric->name, *metric->value(comparison), metric->unit);
    if (metric->name == shift_name) {
      fmt::print(": B lies {:.4f} px to the right and {:.4f} px below", comparison.shift->x, comparison.shift->y);
    }
    fmt::print("\n");
  }
}

void print_json(const std::vector<const Metric*>& chosen, const Comparison& comparison, Scale scale, bool passed) {
  nlohmann::ordered_json json{{"scale", scale == Scale::display ? "display" : "raw"}};
  for (const Metric* metric : chosen) {
    const double value = *metric->value(comparison);
    // JSON has no infinity.
    if (std::isfinite(value)) {
      json[metric->json_name] = value;
    } else {
      json[metric->json_name] = "inf";
    }
  }
  if (comparison.shift) json["shift_xy_px"] = {comparison.shift->x, comparison.shift->y};
  json["mismatches"] = comparison.difference.mismatches;
  json["passed"] = passed;
  fmt::print("{}\n", json.dump(2));
}

/// One line for each limit that was passed, on standard error.
bool check_limits(const std::array<std::optional<double>, metric_count>& limits, const Comparison& comparison) {
  bool passed = true;
  for (size_t i = 0; i < metric_count; ++i) {
    if (!limits[i]) continue;
    const Metric& metric = metrics[i];
    const std::optional<double> value = metric.value(comparison);
    if (!value) throw CommandError("{}: these images have no {}", metric.limit_option, metric.name);
    if (metric.limit_is_minimum ? *value >= *limits[i] : *value <= *limits[i]) continue;
    fmt::print(stderr, "{} is {:.6g}{}, {} {:.6g} was asked for\n", metric.name, *value, metric.unit,
               metric.limit_is_minimum ? "at least" : "at most", *limits[i]);
    passed = false;
  }
  return passed;
}

void run(const Options& options) {
  check_metric_names(options);
  const auto limits = limits_of(options);
  if (options.diff) check_image_output(*options.diff, Channel::color);
  const Scale scale = scale_of(options);
  const Limits limits_of_files = read_options_of(options.reading).limits;
  const Image a = read_image(options.a, limits_of_files), b = read_image(options.b, limits_of_files);
  Comparison comparison{.difference = compare_images(a, b, scale), .shift = {}};
  if (wants_shift(options)) comparison.shift = image_shift(a, b, scale);
  const std::vector<const Metric*> chosen = metrics_of(options, comparison);
  const bool passed = check_limits(limits, comparison);
  options.json ? print_json(chosen, comparison, scale, passed) : print_text(chosen, comparison);
  if (options.diff) write_image(*options.diff, difference_image(a, b, scale), Channel::color);
  if (!passed) throw ExitCode{1};
}

}  // namespace

void add_compare(const Command& tool) {
  const Command command = tool.add_command("compare", "Measure how far apart two images are");
  auto options = std::make_shared<Options>();
  command.add_option("a", options->a, "The first image, the reference").type_name("A").required();
  command.add_option("b", options->b, "The second image").type_name("B").required();
  command
      .add_option("--metric", options->metric, "Some of psnr,ssim,max,mean,id,shift; default: all that apply but shift")
      .type_name("NAMES");
  command.add_flag("--json", options->json, "Print JSON");
  command.add_flag("--raw", options->raw, "Compare 8-bit colour in linear light, not as a screen shows it");
  add_limits(command, options->reading);
  command.add_option("--diff", options->diff, "Write |A - B|, its largest value white").type_name("FILE");
  for (size_t i = 0; i < metric_count; ++i) {
    command.add_option(metrics[i].limit_option, options->limits[i], metrics[i].limit_description)
        .type_name("X")
        .group("Limits (exit code 1 beyond them)");
  }
  command.footer(
      "Colour from .png and .jpg is compared as a screen shows it: sRGB encoded, 0 to 1, so that one step of 8 bits\n"
      "is 0.0039. Everything else is compared in its own unit; the peak of psnr and ssim is then A's largest value.\n"
      "A pixel with a finite value in one image only counts for id, and makes max infinite.\n"
      "shift is how far A has to be moved to look most like B, in fractions of a pixel.\n"
      "Examples:\n"
      "  omma compare a.png b.png\n"
      "  omma compare a.png b.png --metric shift --max-shift 0.01\n"
      "  omma compare a.png b.png --max-max 0.1 --max-mean 0.002 --diff difference.png\n"
      "  omma compare a.npy b.npy --metric id --max-id-share 0.001");
  command.callback([options] { run(*options); });
}

}  // namespace omma::tool
