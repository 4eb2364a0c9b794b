#include "omma/image/pfm.h"

#include <fmt/core.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <ostream>
#include <string>
#include <string_view>

#include "omma/base/error.h"
#include "omma/base/file.h"

namespace omma {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

/// The header's next word; one white character follows it.
std::string_view next_word(std::string_view& text) {
  const size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

template <typename T>
T header_number(std::string_view& text, std::string_view what, const std::string& path) {
  const std::string_view word = next_word(text);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    throw InputError("{}: broken PFM header: the {} is '{}', a number is expected", path, what, word.substr(0, 20));
  }
  return value;
}

}  // namespace

FloatImage read_pfm(const std::filesystem::path& path, const Limits& limits) {
  const std::string name = path.string();
  const std::string bytes = read_file(path, limits);
  std::string_view rest = bytes;
  const std::string_view kind = next_word(rest);
  if (kind != "PF" && kind != "Pf") {
    throw InputError("{}: is not a PFM file (it begins with neither 'PF' nor 'Pf')", name);
  }
  const int width = header_number<int>(rest, "width", name);
  const int height = header_number<int>(rest, "height", name);
  const double scale = header_number<double>(rest, "scale", name);
  if (width <= 0 || height <= 0 || scale == 0.0 || !std::isfinite(scale)) {
    throw InputError("{}: broken PFM header: {} x {}, scale {}; all must differ from zero", name, width, height, scale);
  }
  const int components = kind == "PF" ? 3 : 1;
  if (const std::string why = size_refusal({width, height}, limits); !why.empty()) {
    throw InputError("{}: {}", name, why);
  }
  const size_t row = size_t(width) * components;
  if (rest.size() / sizeof(float) / row < size_t(height)) {
    throw InputError("{}: truncated: {} x {} x {} floats need {} bytes, there are {}", name, width, height, components,
                     row * height * sizeof(float), rest.size());
  }
  FloatImage image({width, height}, components);
  for (int y = 0; y < height; ++y) {
    std::memcpy(image.at(0, height - 1 - y), rest.data() + y * row * sizeof(float), row * sizeof(float));
  }
  if (scale > 0.0) {  // big-endian
    for (float& value : image.values) {
      value = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<uint32_t>(value)));
    }
  }
  return image;
}

void write_pfm(const std::filesystem::path& path, const FloatImage& image) {
  write_stream(path, [&](std::ostream& stream) {
    stream << fmt::format("{}\n{} {}\n-1.0\n", image.components == 3 ? "PF" : "Pf", image.size.width,
                          image.size.height);
    const size_t row = size_t(image.size.width) * image.components * sizeof(float);
    for (int y = image.size.height - 1; y >= 0; --y) {
      stream.write(reinterpret_cast<const char*>(image.at(0, y)), static_cast<std::streamsize>(row));
    }
  });
}

}  // namespace omma
