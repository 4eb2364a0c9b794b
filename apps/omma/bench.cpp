// omma bench: the tables of docs/benchmarks.md and docs/results/.
#include "bench/bench.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "arguments.h"
#include "commands.h"
#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/gl/context.h"

namespace omma::tool {
namespace {

struct Options {
  std::vector<std::string> names;
  Text runs, json, scene;
};

void run(const Options& options) {
  std::vector<std::string> known;
  for (const bench::Benchmark& benchmark : bench::benchmarks()) known.push_back(benchmark.name);
  for (const std::string& name : options.names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw CommandError("{}", unknown_name("benchmark", name, known));
    }
  }
  bench::Options bench_options;
  if (options.runs) bench_options.runs = count_of("--runs", *options.runs, 1, 1000);
  if (options.scene) {
    const auto takes = [&](const bench::Benchmark& benchmark) {
      return benchmark.takes_scene && (options.names.empty() || std::find(options.names.begin(), options.names.end(),
                                                                          benchmark.name) != options.names.end());
    };
    if (std::none_of(bench::benchmarks().begin(), bench::benchmarks().end(), takes)) {
      throw CommandError("--scene is for the benchmark visibility, which is not among those asked for");
    }
    bench_options.scene = *options.scene;
  }
  if (options.json) require_writable(*options.json);

  {
    const gl::Context context;
    fmt::print("{}, OpenGL {}\n", context.renderer(), context.version());
  }
  nlohmann::json results;
  for (const bench::Benchmark& benchmark : bench::benchmarks()) {
    const bool wanted = options.names.empty() ||
                        std::find(options.names.begin(), options.names.end(), benchmark.name) != options.names.end();
    if (!wanted) continue;
    fmt::print("\n## {}: {}\n\n", benchmark.name, benchmark.description);
    results[benchmark.name] = benchmark.run(bench_options);
  }
  if (options.json) write_text(*options.json, results.dump(2) + "\n");
}

}  // namespace

void add_bench(CLI::App& tool) {
  auto options = std::make_shared<Options>();
  CLI::App* command = tool.add_subcommand("bench", "Measures; prints tables of medians and ratios to a baseline");
  std::string names;
  for (const bench::Benchmark& benchmark : bench::benchmarks()) {
    names += fmt::format("  {:<14}{}\n", benchmark.name, benchmark.description);
  }
  command->add_option("NAME", options->names, "Which benchmarks; all without a name");
  command->add_option("--runs", options->runs, "How often each configuration is measured (default 9)");
  command->add_option("--scene", options->scene, "visibility: one more scene, a built-in or a file, for whole frames");
  command->add_option("--json", options->json, "Writes the same numbers to this file");
  command->footer(
      "Benchmarks:\n" + names +
      "All configurations of a table are measured in turn, so that what disturbs the machine disturbs them\n"
      "alike. A time is the median of its runs, with the 10th and 90th percentile behind it.\n"
      "Example:\n"
      "  omma bench image-based --runs 5 --json out.json");
  command->callback([options] { run(*options); });
}

}  // namespace omma::tool
