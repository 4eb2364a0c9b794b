#include "omma/shading/color_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/image/srgb.h"

namespace omma {
namespace {

struct NamedColor {
  std::string_view name;
  uint32_t srgb;
};
constexpr NamedColor named_colors[] = {
    {"black", 0x000000}, {"white", 0xffffff}, {"grey", 0x808080},   {"red", 0xd02020},
    {"green", 0x209030}, {"blue", 0x2050d0},  {"yellow", 0xf0d020},
};

glm::vec3 linear(uint32_t srgb) {
  const auto component = [&](int shift) { return linear_from_srgb(float((srgb >> shift) & 255u) / 255.0f); };
  return {component(16), component(8), component(0)};
}

}  // namespace

glm::vec3 parse_color(std::string_view what, std::string_view text) {
  std::vector<std::string> names;
  for (const NamedColor& color : named_colors) {
    if (text == color.name) return linear(color.srgb);
    names.emplace_back(color.name);
  }
  const std::string_view digits = text.starts_with('#') ? text.substr(1) : text;
  uint32_t srgb = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), srgb, 16);
  if (digits.size() == 6 && error == std::errc{} && end == digits.data() + digits.size()) return linear(srgb);
  throw CommandError("{}: {}, or six hexadecimal digits of sRGB such as ff8000", what,
                     unknown_name("colour", text, names));
}

}  // namespace omma
