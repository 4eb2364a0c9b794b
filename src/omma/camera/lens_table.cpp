#include "omma/camera/lens_table.h"

#include <fmt/core.h>

#include <cctype>

#include "omma/camera/camera_parameters.h"
#include "omma/camera/lens_model.h"

namespace omma {
namespace {

std::string fov_range(const LensInfo& info) {
  if (info.max_fov_deg == 0) return "fills the image";
  return fmt::format("{}{}°", info.max_fov_inclusive ? "up to " : "below ", info.max_fov_deg);
}

std::string default_fit(const LensInfo& info) {
  return info.max_fov_deg == 0 ? "none" : fmt::format("`{}`", fit_name(info.default_fit));
}

std::string default_fov(const LensInfo& info) {
  return info.default_fov_deg == 0 ? "none" : fmt::format("{}°", info.default_fov_deg);
}

// "a, b, c (k=1)": other names, and those that set something with what they set.
std::string all_names(const LensInfo& info) {
  std::string text = info.also;
  for (const LensPreset& preset : info.presets) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", preset.name, preset.settings);
  }
  return text;
}

std::string value_range(const LensParameterInfo& parameter) {
  return parameter.choices ? parameter.choices : fmt::format("{} to {}", parameter.min, parameter.max);
}

std::string default_value(const LensParameterInfo& parameter) {
  return parameter.choices ? choices(parameter).at(static_cast<size_t>(parameter.default_value))
                           : fmt::format("{}", parameter.default_value);
}

std::vector<const LensInfo*> lenses_of(const std::string& group) {
  std::vector<const LensInfo*> lenses;
  for (const LensModel& model : lens_models()) {
    if (group == model.info.group) lenses.push_back(&model.info);
  }
  return lenses;
}

// "Radial lenses".
std::string heading(std::string group) {
  group[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(group[0])));
  return group + " lenses";
}

// Those of the examples, three in a row; docs/camera_pictures.sh renders them.
std::string pictures(const std::vector<const LensInfo*>& lenses) {
  std::string text = "\n| | | |\n|---|---|---|\n";
  for (size_t i = 0; i < lenses.size() || i % 3 != 0; ++i) {
    text += i < lenses.size() ? fmt::format("| ![{0}](images/cameras/{0}.jpg) `{0}` ", lenses[i]->name) : "| ";
    if (i % 3 == 2) text += "|\n";
  }
  return text;
}

}  // namespace

std::string lens_table_markdown() {
  std::string text;
  for (const char* group : lens_groups) {
    const std::vector<const LensInfo*> lenses = lenses_of(group);
    if (lenses.empty()) continue;
    text += fmt::format(
        "{}## {}\n\n"
        "| name | other names | formula | `fov_deg` | default | default `fit` | source |\n"
        "|---|---|---|---|---|---|---|\n",
        text.empty() ? "" : "\n", heading(group));
    for (const LensInfo* info : lenses) {
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", info->name, all_names(*info), info->formula,
                          fov_range(*info), default_fov(*info), default_fit(*info), info->source);
    }
    text += pictures(lenses);
    for (const LensInfo* info : lenses) {
      if (info->parameters.empty()) continue;
      text += fmt::format("\nParameters of `{}`, for example `{}`:\n\n", info->name, info->example);
      text += "| parameter | default | range | meaning |\n|---|---|---|---|\n";
      for (const LensParameterInfo& parameter : info->parameters) {
        text += fmt::format("| `{}` | {} | {} | {} |\n", parameter.name, default_value(parameter),
                            value_range(parameter), parameter.description);
      }
    }
  }
  text += "\n## Parameters of every lens\n\n| parameter | default | meaning |\n|---|---|---|\n";
  for (const CameraParameterInfo& parameter : common_camera_parameters()) {
    text += fmt::format("| `{}` | {} | {} |\n", parameter.name, parameter.default_text, parameter.description);
  }
  return text;
}

std::string lens_table_text() {
  std::string text;
  for (const char* group : lens_groups) {
    const std::vector<const LensInfo*> lenses = lenses_of(group);
    if (!lenses.empty()) text += fmt::format("{}\n\n", heading(group));
    for (const LensInfo* info : lenses) {
      const std::string fov = info->max_fov_deg == 0 ? "none, the layout fills the image"
                                                     : fmt::format("{}, default {}, spans the {}", fov_range(*info),
                                                                   default_fov(*info), fit_name(info->default_fit));
      text += fmt::format("{}\n  also     {}\n  formula  {}\n  fov_deg  {}\n", info->name, all_names(*info),
                          info->formula, fov);
      for (const LensParameterInfo& parameter : info->parameters) {
        text += fmt::format("  {:<8} {} ({}, default {})\n", parameter.name, parameter.description,
                            value_range(parameter), default_value(parameter));
      }
      text += fmt::format("  example  {}\n  source   {}\n\n", info->example, info->source);
    }
  }
  text += "Every lens takes:\n";
  for (const CameraParameterInfo& parameter : common_camera_parameters()) {
    text += fmt::format("  {:<14} {} (default: {})\n", parameter.name, parameter.description, parameter.default_text);
  }
  return text;
}

}  // namespace omma
