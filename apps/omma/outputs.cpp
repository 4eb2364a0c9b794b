#include "outputs.h"

#include <algorithm>
#include <optional>
#include <set>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/image/write.h"

namespace omma::tool {
namespace {

struct Pattern {
  size_t begin, end;  ///< in the path
  int digits;
  bool zeros;
};

/// The place of `%d`, `%4d` or `%04d`. Throws CommandError for any other use of '%', as in printf `%%` is no pattern.
std::optional<Pattern> find_pattern(const std::string& path) {
  std::optional<Pattern> pattern;
  for (size_t begin = path.find('%'); begin != std::string::npos; begin = path.find('%', begin + 1)) {
    const size_t end = path.find_first_not_of("0123456789", begin + 1);
    const std::string digits = path.substr(begin + 1, end - begin - 1);
    if (end == std::string::npos || path[end] != 'd' || digits.size() > 2) {
      throw CommandError("{}: '%' begins the place of the frame's number, %04d is expected", path);
    }
    if (pattern) throw CommandError("{}: has two places for the frame's number, one is expected", path);
    pattern = {begin, end + 1, digits.empty() ? 0 : std::stoi(digits), digits.starts_with('0')};
  }
  return pattern;
}

Output parse_output(const std::string& text) {
  Output output{text};
  const size_t colon = text.rfind(':');
  // A colon that is followed by a dot or a slash belongs to the file's name.
  if (colon != std::string::npos && text.find_first_of("./", colon) == std::string::npos) {
    output.path = text.substr(0, colon);
    output.channel = channel_from_name(text.substr(colon + 1));
  }
  if (output.path.empty()) throw CommandError("-o: '{}' names no file", text);
  check_image_output(output.path_of(0), output.channel);
  return output;
}

}  // namespace

bool Output::has_pattern() const { return find_pattern(path).has_value(); }

std::filesystem::path Output::path_of(int frame) const {
  const std::optional<Pattern> pattern = find_pattern(path);
  if (!pattern) return path;
  const std::string number =
      pattern->zeros ? fmt::format("{:0{}}", frame, pattern->digits) : fmt::format("{:{}}", frame, pattern->digits);
  return path.substr(0, pattern->begin) + number + path.substr(pattern->end);
}

std::vector<Output> parse_outputs(const std::vector<std::string>& texts) {
  std::vector<Output> outputs;
  std::set<std::filesystem::path> paths;
  for (const std::string& text : texts) {
    outputs.push_back(parse_output(text));
    if (!paths.insert(std::filesystem::absolute(outputs.back().path).lexically_normal()).second) {
      throw CommandError("-o: '{}' is named twice; each channel needs a file of its own", outputs.back().path);
    }
  }
  return outputs;
}

}  // namespace omma::tool
