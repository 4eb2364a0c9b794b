#include "omma/technique/effect_program.h"

#include <fmt/core.h>

#include <cctype>

namespace omma {
namespace {

/// The GLSL struct of an effect's parameters: its name, with a capital.
std::string type_name(const EffectInfo& info) {
  std::string name = info.name;
  name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

}  // namespace

gl::Defines effect_defines(std::span<const Effect> chain) {
  if (chain.empty()) return {};
  gl::Defines defines{{"EFFECTS", ""}, {"EFFECT_UNIFORMS", ""}, {"PAINT_EFFECTS", ""}, {"DRAW_EFFECTS", ""}};
  for (size_t i = 0; i < chain.size(); ++i) {
    const EffectInfo& info = *chain[i].info;
    defines[fmt::format("EFFECT_{}", i)] = info.name;
    defines["EFFECT_UNIFORMS"] += fmt::format("uniform {} effect_{}; ", type_name(info), i);
    defines[info.paints ? "PAINT_EFFECTS" : "DRAW_EFFECTS"] +=
        fmt::format("color = {}(effect_{}, surface, color); ", info.name, i);
  }
  return defines;
}

void set_effects(const gl::Program& program, std::span<const Effect> chain) {
  for (size_t i = 0; i < chain.size(); ++i) {
    for (size_t p = 0; p < chain[i].values.size(); ++p) {
      const std::string name = fmt::format("effect_{}.{}", i, chain[i].info->parameters[p].name);
      std::visit([&](const auto& value) { program.set(name.c_str(), value); }, chain[i].values[p]);
    }
  }
}

}  // namespace omma
