#include "omma/scene/file/json_depth.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

#include "omma/base/error.h"

namespace omma::file {
namespace {

/// Follows brackets through a text that comes in parts; what is well-formed is the parser's to say.
class Depth {
 public:
  /// The deepest so far.
  size_t after(std::string_view text) {
    for (const char c : text) {
      if (in_string_) {
        in_string_ = escaped_ || c != '"';
        escaped_ = !escaped_ && c == '\\';
      } else if (c == '"') {
        in_string_ = true;
      } else if (c == '{' || c == '[') {
        deepest_ = std::max(deepest_, ++depth_);
      } else if ((c == '}' || c == ']') && depth_ > 0) {
        --depth_;
      }
    }
    return deepest_;
  }

 private:
  size_t depth_ = 0, deepest_ = 0;
  bool in_string_ = false, escaped_ = false;
};

/// Where the JSON ends, the stream being moved to its beginning. A .glb has a header of 12 bytes and one of 8 for the
/// chunk, which begins with its length (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html, section 4.4).
uint64_t seek_json(std::ifstream& stream) {
  std::array<char, 20> header{};
  stream.read(header.data(), header.size());
  const bool binary = stream && std::memcmp(header.data(), "glTF", 4) == 0;
  stream.clear();
  stream.seekg(binary ? static_cast<std::streamoff>(header.size()) : 0);
  uint32_t length = 0;
  std::memcpy(&length, &header[12], sizeof length);
  return binary ? length : std::numeric_limits<uint64_t>::max();
}

}  // namespace

void require_shallow_json(const std::filesystem::path& path, const Limits& limits) {
  std::ifstream stream(path, std::ios::binary);
  uint64_t left = seek_json(stream);
  std::array<char, 65536> part;
  Depth depth;
  while (left > 0 && stream) {
    stream.read(part.data(), static_cast<std::streamsize>(std::min<uint64_t>(left, part.size())));
    const auto count = static_cast<size_t>(stream.gcount());
    left -= count;
    if (depth.after({part.data(), count}) > limits.document_depth) {
      throw InputError("scene file '{}' is nested more than {} levels deep: {}", path.string(), limits.document_depth,
                       limit_text(limits, &Limits::document_depth));
    }
  }
}

}  // namespace omma::file
