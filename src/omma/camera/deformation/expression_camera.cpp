// Cameras of typed formulae, so that a new projection needs no compiler.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "omma/base/error.h"
#include "omma/camera/camera_parameters.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/camera/deformation/expression.h"
#include "omma/camera/deformation/radial_camera.h"
#include "omma/camera/deformation/text_rows.h"

namespace omma {
namespace {

// The ways to say what a pixel sees: their formulae and what those are formulae of.
struct Form {
  std::vector<const char*> formulae;
  std::vector<std::string> variables;
};

const std::vector<Form>& forms() {
  static const std::vector<std::string> image = {"u", "v", "aspect"};
  static const std::vector<Form> all = {
      {{"r"}, {"theta"}}, {{"theta"}, {"r"}}, {{"longitude", "latitude"}, image}, {{"x", "y", "z"}, image}};
  return all;
}

std::string trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

// A formula's text and where it stands.
struct Source {
  std::string text;
  std::string file;  ///< file and line; empty: the command line
};

// What an expression camera's text and file say together; the command line wins.
class Sources {
 public:
  Sources(const Spec& spec, const Limits& limits) : spec_{spec.name, {}} {
    if (const auto file = spec.values.find("file"); file != spec.values.end()) read(file->second, limits);
    for (const auto& [key, value] : spec.values) {
      if (key == "file") continue;
      spec_.values[key] = value;
      places_.erase(key);
    }
  }

  const Spec& spec() const { return spec_; }

  /// The formula of a key. Throws InputError when it stands in a file and is wrong, else CommandError.
  Expression expression(const std::string& key, std::span<const std::string> variables) const {
    const std::string what = fmt::format("{}: {}", spec_.name, key);
    const auto place = places_.find(key);
    if (place == places_.end()) return Expression(what, spec_.values.at(key), variables);
    try {
      return Expression(key, spec_.values.at(key), variables);
    } catch (const CommandError& error) {
      throw InputError("{}: {}", place->second, error.what());
    }
  }

 private:
  void read(const std::string& path, const Limits& limits) {
    for_each_line(path, limits, [&](std::string_view text, size_t number) {
      const std::string line = trimmed(text);
      if (line.empty()) return;
      const std::string place = fmt::format("{}:{}", path, number);
      const size_t equals = line.find('=');
      const std::string key = trimmed(std::string_view(line).substr(0, equals));
      if (equals == std::string::npos || key.empty()) {
        throw InputError("{}: '{}' is not key = value, for example r = 2*sin(theta/2)", place, line.substr(0, 80));
      }
      if (key == "file") throw InputError("{}: file: a file cannot name another", place);
      if (!spec_.values.emplace(key, trimmed(std::string_view(line).substr(equals + 1))).second) {
        throw InputError("{}: '{}' is given twice", place, key);
      }
      places_[key] = place;
    });
  }

  Spec spec_;
  std::map<std::string, std::string> places_;  // of the keys that come from the file
};

const Form& form_of(const DeformationText& text) {
  const Form* found = nullptr;
  for (const Form& form : forms()) {
    if (std::ranges::none_of(form.formulae, [&](const char* key) { return text.has(key); })) continue;
    if (found) {
      throw CommandError("{} and {} both say what a pixel sees; give one of them", text.label(found->formulae.front()),
                         form.formulae.front());
    }
    found = &form;
  }
  if (!found) {
    throw CommandError(
        "{}: no formula; r (of theta), theta (of r), longitude and latitude, or x, y and z (of u, v) "
        "are accepted, for example {}",
        text.spec().name, find_deformation("expression")->example);
  }
  for (const char* key : found->formulae) {
    if (!text.has(key))
      throw CommandError("{} is missing beside {}", text.label(key), fmt::join(found->formulae, ", "));
  }
  return *found;
}

// How far r must be followed until θ(r) is half a turn, or the formula ends.
double radius_to_follow(const Expression& angle) {
  double radius = 1.0;
  for (int i = 0; i < 20; ++i) {
    const double value = angle(std::span(&radius, 1));
    if (!(value < std::numbers::pi)) break;
    radius *= 2.0;
  }
  return radius;
}

Camera radial(const DeformationText& text, const Expression& formula, bool radius_of_angle,
              std::optional<ImageSize> size) {
  const double high = radius_of_angle ? std::numbers::pi : radius_to_follow(formula);
  RadialForm form{RisingFunction([&](double x) { return formula(std::span(&x, 1)); }, 0.0, high), radius_of_angle};
  const char *key = radius_of_angle ? "r" : "theta", *variable = radius_of_angle ? "theta" : "r";
  const double first = form.function.low_value();
  if (!std::isfinite(first) || first < 0.0) {
    throw CommandError("{}: is {} at {} = 0; 0, or more for a camera with a hole around its axis, is expected",
                       text.label(key), first, variable);
  }
  if (!(form.function.end() > 0.0)) {
    throw CommandError("{}: does not rise with {} from {} = 0 on", text.label(key), variable, variable);
  }
  return make_radial_camera(text, form, size);
}

Camera by_image_point(const DeformationText& text, const std::vector<Expression>& formulae,
                      std::optional<ImageSize> size) {
  const ImageSize own = text.own_size().value_or(size.value_or(default_image_size));
  const ImageSize wanted = size.value_or(own);
  if (wanted != own) image_scale(text.label("width"), own, wanted);
  const double aspect = static_cast<double>(wanted.width) / wanted.height;
  return deformed_camera(
      wanted, source_text(text.spec(), wanted, glm::dvec2(1.0)), text.limits(),
      [&](const glm::dvec2& pixel) -> std::optional<glm::dvec3> {
        const double values[] = {2.0 * pixel.x / wanted.width - 1.0, 1.0 - 2.0 * pixel.y / wanted.height, aspect};
        const double a = formulae[0](values), b = formulae[1](values);
        if (formulae.size() == 3) return glm::dvec3(a, b, formulae[2](values));
        if (!(std::abs(b) <= 0.5 * std::numbers::pi * (1.0 + 1e-12))) return {};
        return glm::dvec3(std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b));
      });
}

}  // namespace

Camera make_expression_camera(const Spec& spec, std::optional<ImageSize> size, const Limits& limits) {
  const Sources sources(spec, limits);
  const DeformationText text(sources.spec(), limits);
  std::vector<const char*> keys;
  for (const Form& form : forms()) keys.insert(keys.end(), form.formulae.begin(), form.formulae.end());
  const Form& form = form_of(text);
  const bool is_radial = form.formulae.size() == 1;
  if (is_radial) {
    keys.insert(keys.end(), radial_keys.begin(), radial_keys.end());
  } else {
    keys.insert(keys.end(), {"width", "height"});
  }
  keys.push_back("file");
  text.accept_only(keys);
  std::vector<Expression> formulae;
  for (const char* key : form.formulae) formulae.push_back(sources.expression(key, form.variables));
  if (is_radial) return radial(text, formulae.front(), std::string_view(form.formulae.front()) == "r", size);
  return by_image_point(text, formulae, size);
}

}  // namespace omma
