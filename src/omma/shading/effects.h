// Effects: what is painted on surfaces before they are lit, and drawn over them afterwards. They are written once, by
// screen-space derivatives of the surface, and every technique draws them.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace omma {

/// A number, a colour or one of several names. Its name is that of the member in the effect's GLSL struct.
struct EffectParameter {
  const char* name;
  const char* default_text;
  const char* description;
  double min = 0.0, max = 0.0;    ///< of a number; equal for the others
  const char* choices = nullptr;  ///< the names of the values 0, 1, …, separated by ", "
  bool is_number() const { return min < max; }
};

struct EffectInfo {
  const char* name;  ///< as in texts; also its file and its function in shaders/shading/effects/
  bool paints;       ///< gives the surface its colour before light falls on it; otherwise it changes the lit colour
  const char* description;
  const char* example;  ///< as make_effect takes it
  std::vector<EffectParameter> parameters;
};

/// Every effect, in the order in which they are listed.
const std::vector<EffectInfo>& effects();

/// An effect with its parameters: numbers in the units their names end in, choices by their place, colours linear.
struct Effect {
  const EffectInfo* info;
  std::vector<std::variant<float, int, glm::vec3>> values;  ///< in the order of info->parameters
};

/// `wireframe:width_px=2,color=black`; a colour is a name or six hexadecimal digits of sRGB. Throws CommandError with
/// what is accepted or the nearest name.
Effect make_effect(std::string_view text);

inline constexpr size_t max_effects = 4;

/// Throws CommandError for more than max_effects, and for two that paint: nothing would be left of the first.
void check_effects(std::span<const Effect> chain);

/// The effects with their parameters, for people; `markdown`: the tables of docs/effects.md.
std::string effect_table(bool markdown);

}  // namespace omma
