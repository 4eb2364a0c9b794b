#include "omma/camera/lens_model.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "omma/base/names.h"
#include "omma/camera/polynomial.h"

namespace omma {
namespace {

constexpr double pi = 3.14159265358979323846;

// How far a lens stays away from an angle that its formula cannot reach: its image is still finite there.
constexpr double open_end = 1e-6;

struct FloatParameters {
  std::array<float, LensParameters::max_count> k{};
  float max_angle = 0.0F;

  FloatParameters(const LensParameters& parameters) : max_angle(static_cast<float>(parameters.max_angle)) {
    std::copy(parameters.k.begin(), parameters.k.end(), k.begin());
  }
};

#define OUT(type) type&
#define LENS_FUNCTION inline

namespace in_double {
using namespace glm;
using real = double;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using Params = const LensParameters&;
constexpr real lens_epsilon = std::numeric_limits<real>::epsilon();
#include "all_lenses.inc"
}  // namespace in_double

namespace in_float {
using namespace glm;
using real = float;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using Params = const FloatParameters&;
constexpr real lens_epsilon = std::numeric_limits<real>::epsilon();
#include "all_lenses.inc"
}  // namespace in_float

template <auto function, typename From, typename To>
bool with_float_parameters(const LensParameters& parameters, From from, To& to) {
  return function(FloatParameters(parameters), from, to);
}

constexpr LensModel models[] = {
#define OMMA_LENS(lens)                                                            \
  {in_double::lens##_info, in_double::lens##_project, in_double::lens##_unproject, \
   with_float_parameters<in_float::lens##_project>, with_float_parameters<in_float::lens##_unproject>},
#include "omma/camera/models/models.def"
#undef OMMA_LENS
};

// The parts of "a, b, c".
std::vector<std::string> names_in(const char* list) {
  std::vector<std::string> names = split(list, ',');
  for (std::string& name : names) name.erase(0, name.find_first_not_of(' '));
  return names;
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace

const char* fit_name(Fit fit) {
  constexpr const char* names[] = {"width", "height", "shorter", "longer", "diagonal"};
  return names[static_cast<int>(fit)];
}

std::span<const LensModel> lens_models() { return models; }

std::vector<PlanePolygon> plane_squares(int columns, int rows) {
  std::vector<PlanePolygon> squares;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const glm::dvec2 corner(2 * column - columns, 2 * row - rows);
      squares.push_back({corner, corner + glm::dvec2(2, 0), corner + glm::dvec2(2, 2), corner + glm::dvec2(0, 2)});
    }
  }
  return squares;
}

LensParameters lens_parameters(const LensInfo& info, std::span<const double> values) {
  LensParameters parameters;
  for (size_t i = 0; i < info.parameters.size(); ++i) {
    parameters.k[i] = i < values.size() ? values[i] : info.parameters[i].default_value;
  }
  if (info.derive) info.derive(parameters);
  parameters.max_angle = info.max_angle(parameters);
  return parameters;
}

std::vector<std::string> other_names(const LensInfo& info) { return names_in(info.also); }

std::vector<std::string> choices(const LensParameterInfo& parameter) {
  return parameter.choices ? names_in(parameter.choices) : std::vector<std::string>();
}

const LensPreset* find_lens_preset(std::string_view name) {
  for (const LensModel& model : models) {
    for (const LensPreset& preset : model.info.presets) {
      if (equal_but_for_case(name, preset.name)) return &preset;
    }
  }
  return nullptr;
}

const LensModel* find_lens_model(std::string_view name) {
  for (const LensModel& model : models) {
    const auto is_name = [&](std::string_view other) { return equal_but_for_case(name, other); };
    if (is_name(model.info.name) || std::ranges::any_of(other_names(model.info), is_name) ||
        std::ranges::any_of(model.info.presets, is_name, &LensPreset::name)) {
      return &model;
    }
  }
  return nullptr;
}

}  // namespace omma
