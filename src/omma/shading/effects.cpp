#include "omma/shading/effects.h"

#include <algorithm>
#include <cctype>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/shading/color_text.h"

namespace omma {
namespace {

const std::vector<EffectInfo> list{
    {"wireframe",
     false,
     "the edges of all triangles as lines of constant width",
     "wireframe:width_px=2",
     {{"width_px", "1.5", "width of a line between two triangles; at an outline, where one is seen, half of it", 0.1,
       64},
      {"color", "black", "of the lines"}}},
    {"hatching",
     false,
     "pen and ink: strokes of constant width, the denser the darker the surface, tied to it and as far apart on the "
     "screen wherever it is",
     "hatching:width_px=1.2,spacing_px=4,crossing=0.4",
     {{"width_px", "1.2", "width of a stroke", 0.1, 64},
      {"spacing_px", "2.5", "from stroke to stroke where the surface is black; twice that where it is half as dark",
       0.5, 256},
      {"angle_deg", "0", "of the strokes in the plane that `map` spans, from its first axis", -360, 360},
      {"crossing", "0.5", "darkness, 0 to 1, from which strokes cross; 1: none do", 0, 1},
      {"map", "uv",
       "what strokes follow: texture coordinates (where a mesh has none, the world) or world metres along the two axes "
       "that the surface faces least",
       0, 0, "uv, world"},
      {"ink", "black", "of the strokes"},
      {"paper", "white", "of all surfaces between them; the background is `--background`'s"}}},
    {"contours",
     false,
     "lines of equal height, of constant width",
     "contours:interval_m=5,color=red",
     {{"interval_m", "1", "metres of height from line to line", 1e-4, 1e6},
      {"base_m", "0", "height of one of the lines in the world", -1e6, 1e6},
      {"width_px", "1.5", "width of a line", 0.1, 64},
      {"color", "black", "of the lines"}}},
    {"checker",
     true,
     "a checkerboard in world metres, lit as the material is",
     "checker:size_m=0.5",
     {{"size_m", "1", "side of a square", 1e-4, 1e6},
      {"color", "white", "of one half of the squares"},
      {"other_color", "#404040", "of the other half"}}},
    {"brick",
     true,
     "a brick wall in running bond in world metres, lit as the material is",
     "brick:length_m=0.5,height_m=0.2,mortar_m=0.03",
     {{"length_m", "0.25", "from joint to joint along a course", 1e-4, 1e6},
      {"height_m", "0.083", "from course to course", 1e-4, 1e6},
      {"mortar_m", "0.012", "width of the joints", 0, 1e6},
      {"color", "#9c4a33", "of the bricks"},
      {"mortar_color", "#b8b0a4", "of the joints"}}},
};

std::variant<float, int, glm::vec3> parse_value(const std::string& what, const EffectParameter& parameter,
                                                const std::string& text) {
  if (parameter.choices != nullptr) {
    std::vector<std::string> choices;
    for (std::string& choice : split(parameter.choices, ','))
      choices.push_back(choice.substr(choice.find_first_not_of(' ')));
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end()) throw CommandError("{}: {}", what, unknown_name("choice", text, choices));
    return int(found - choices.begin());
  }
  if (!parameter.is_number()) return parse_color(what, text);
  const double value = parse_number(what, text);
  if (value < parameter.min || value > parameter.max) {
    throw CommandError("{} is {}, but must lie between {} and {}", what, value, parameter.min, parameter.max);
  }
  return float(value);
}

std::string range_text(const EffectParameter& parameter) {
  if (parameter.choices != nullptr) return parameter.choices;
  return parameter.is_number() ? fmt::format("{:g} to {:g}", parameter.min, parameter.max) : "colour";
}

}  // namespace

const std::vector<EffectInfo>& effects() { return list; }

Effect make_effect(std::string_view text) {
  const Spec spec = parse_spec(text);
  const auto info = std::find_if(list.begin(), list.end(), [&](const EffectInfo& e) { return e.name == spec.name; });
  if (info == list.end()) {
    std::vector<std::string> names;
    for (const EffectInfo& known : list) names.emplace_back(known.name);
    throw CommandError("{}", unknown_name("effect", spec.name, names));
  }
  Effect effect{&*info, {}};
  std::vector<std::string> names;
  for (const EffectParameter& parameter : info->parameters) {
    names.emplace_back(parameter.name);
    const auto given = spec.values.find(parameter.name);
    effect.values.push_back(parse_value(fmt::format("effect {}: {}", info->name, parameter.name), parameter,
                                        given == spec.values.end() ? parameter.default_text : given->second));
  }
  for (const auto& [key, value] : spec.values) {
    if (std::find(names.begin(), names.end(), key) == names.end()) {
      throw CommandError("{}", unknown_name(fmt::format("parameter of effect {}", info->name), key, names));
    }
  }
  return effect;
}

void check_effects(std::span<const Effect> chain) {
  if (chain.size() > max_effects) {
    throw CommandError("{} effects are asked for; one picture takes up to {}", chain.size(), max_effects);
  }
  const EffectInfo* paint = nullptr;
  for (const Effect& effect : chain) {
    if (!effect.info->paints) continue;
    if (paint != nullptr) {
      throw CommandError("the effects {} and {} both give surfaces their colour; give one of them", paint->name,
                         effect.info->name);
    }
    paint = effect.info;
  }
}

std::string effect_table(bool markdown) {
  std::string text;
  for (const EffectInfo& effect : list) {
    if (markdown) {
      std::string sentence = effect.description;
      sentence[0] = char(std::toupper(static_cast<unsigned char>(sentence[0])));
      text += fmt::format("## `{0}`\n\n![{0}](images/effect_{0}.png)\n\n{1}: `--effect {2}`.\n\n", effect.name,
                          sentence, effect.example);
      text += "| parameter | default | accepted | |\n|---|---|---|---|\n";
    } else {
      text += fmt::format("{}\n    {}\n", effect.name, effect.description);
    }
    for (const EffectParameter& parameter : effect.parameters) {
      if (markdown) {
        text += fmt::format("| `{}` | {} | {} | {} |\n", parameter.name, parameter.default_text, range_text(parameter),
                            parameter.description);
      } else {
        text += fmt::format("    {:<14}{} (default {}; {})\n", parameter.name, parameter.description,
                            parameter.default_text, range_text(parameter));
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace omma
