// omma-bench, which omma bench runs: the tables of docs/benchmarks.md.
#include <fmt/core.h>

#include <algorithm>

#include "apps/omma/arguments.h"
#include "apps/omma/command_line.h"
#include "bench/bench.h"
#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/gl/context.h"

namespace omma::bench {
namespace {

struct Words {
  std::vector<std::string> names;
  tool::Text runs, json, scene;
};

/// Whether it was asked for, as all are without a name.
bool is_wanted(const Words& words, const Benchmark& benchmark) {
  return words.names.empty() || std::find(words.names.begin(), words.names.end(), benchmark.name) != words.names.end();
}

Options options_of(const Words& words) {
  std::vector<std::string> known;
  for (const Benchmark& benchmark : benchmarks()) known.push_back(benchmark.name);
  for (const std::string& name : words.names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw CommandError("{}", unknown_name("benchmark", name, known));
    }
  }
  Options options;
  if (words.runs) options.runs = tool::count_of("--runs", *words.runs, 1, 1000);
  if (words.scene) {
    const auto takes = [&](const Benchmark& benchmark) { return benchmark.takes_scene && is_wanted(words, benchmark); };
    if (std::none_of(benchmarks().begin(), benchmarks().end(), takes)) {
      throw CommandError("--scene is for the benchmark visibility, which is not among those asked for");
    }
    options.scene = *words.scene;
  }
  if (words.json) require_writable(*words.json);
  return options;
}

void measure(const Words& words) {
  const Options options = options_of(words);
  {
    const gl::Context context;
    fmt::print("{}, OpenGL {}\n", context.renderer(), context.version());
  }
  nlohmann::json results;
  for (const Benchmark& benchmark : benchmarks()) {
    if (!is_wanted(words, benchmark)) continue;
    fmt::print("\n## {}: {}\n\n", benchmark.name, benchmark.description);
    results[benchmark.name] = benchmark.run(options);
  }
  if (words.json) write_text(*words.json, results.dump(2) + "\n");
}

}  // namespace
}  // namespace omma::bench

int main(int argc, char** argv) {
  omma::bench::Words words;
  omma::tool::Program program("omma bench", "Measures; prints tables of medians and ratios to a baseline");
  std::string names;
  for (const omma::bench::Benchmark& benchmark : omma::bench::benchmarks()) {
    names += fmt::format("  {:<14}{}\n", benchmark.name, benchmark.description);
  }
  program.add_option("NAME", words.names, "Which benchmarks; all without a name");
  program.add_option("--runs", words.runs, "How often each configuration is measured (default 9)");
  program.add_option("--scene", words.scene, "visibility: one more scene, a built-in or a file, for whole frames");
  program.add_option("--json", words.json, "Writes the same numbers to this file");
  program.footer("Benchmarks:\n" + names +
                 "All configurations of a table are measured in turn, so that what disturbs the machine disturbs them\n"
                 "alike. A time is the median of its runs, with the 10th and 90th percentile behind it.\n"
                 "Example:\n"
                 "  omma bench image-based --runs 5 --json out.json");
  program.callback([&words] { omma::bench::measure(words); });
  return program.run(argc, argv);
}
