// omma bench: runs omma-bench, which most who render never build.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "commands.h"
#include "omma/base/error.h"

namespace omma::tool {
namespace {

constexpr const char* program = "omma-bench";

/// Becomes the program: the one beside this, else one in the PATH.
void become_bench(std::vector<std::string> words) {
  words.insert(words.begin(), program);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::error_code error;
  const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe", error).replace_filename(program);
  if (!error) ::execv(beside.c_str(), pointers.data());
  if (error || errno == ENOENT) ::execvp(program, pointers.data());
  if (errno != ENOENT) throw MachineError("{} cannot be run: {}", program, std::strerror(errno));
  throw MachineError(
      "{0}, a program of its own that measures and prints the tables of docs/benchmarks.md, is neither beside omma nor "
      "the PATH; from a checkout './dev bench' builds and runs it, elsewhere 'cmake --build BUILD --target omma_bench' "
      "builds it",
      program);
}

}  // namespace

void add_bench(const Command& tool) {
  const Command command = tool.add_command("bench", "Measures; prints tables of medians and ratios to a baseline");
  command.pass_words_on(become_bench);
}

}  // namespace omma::tool
