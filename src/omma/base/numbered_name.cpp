#include "omma/base/numbered_name.h"

#include <fmt/core.h>

#include <optional>

#include "omma/base/error.h"

namespace omma {
namespace {

struct Pattern {
  size_t begin, end;  ///< in the name
  int digits;
  bool zeros;
};

std::optional<Pattern> find_pattern(const std::string& name) {
  std::optional<Pattern> pattern;
  for (size_t begin = name.find('%'); begin != std::string::npos; begin = name.find('%', begin + 1)) {
    const size_t end = name.find_first_not_of("0123456789", begin + 1);
    const std::string digits = name.substr(begin + 1, end - begin - 1);
    if (end == std::string::npos || name[end] != 'd' || digits.size() > 2) {
      throw CommandError("{}: '%' begins the place of the frame's number, %04d is expected", name);
    }
    if (pattern) throw CommandError("{}: has two places for the frame's number, one is expected", name);
    pattern = {begin, end + 1, digits.empty() ? 0 : std::stoi(digits), digits.starts_with('0')};
  }
  return pattern;
}

}  // namespace

bool has_number_pattern(const std::string& name) { return find_pattern(name).has_value(); }

std::string numbered_name(const std::string& name, int number) {
  const std::optional<Pattern> pattern = find_pattern(name);
  if (!pattern) return name;
  const std::string text =
      pattern->zeros ? fmt::format("{:0{}}", number, pattern->digits) : fmt::format("{:{}}", number, pattern->digits);
  return name.substr(0, pattern->begin) + text + name.substr(pattern->end);
}

}  // namespace omma
