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

  explicit FloatParameters(const LensParameters& parameters) : max_angle(static_cast<float>(parameters.max_angle)) {
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
using Params = const LensParameters&;
constexpr real lens_epsilon = std::numeric_limits<real>::epsilon();
#include "all_lenses.inc"
}  // namespace in_double

namespace in_float {
using namespace glm;
using real = float;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
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

}  // namespace

const char* fit_name(Fit fit) {
  constexpr const char* names[] = {"width", "height", "shorter", "longer", "diagonal"};
  return names[static_cast<int>(fit)];
}

std::span<const LensModel> lens_models() { return models; }

std::vector<std::string> other_names(const LensInfo& info) {
  std::vector<std::string> names = split(info.also, ',');
  for (std::string& name : names) name.erase(0, name.find_first_not_of(' '));
  return names;
}

const LensModel* find_lens_model(std::string_view name) {
  for (const LensModel& model : models) {
    const std::vector<std::string> others = other_names(model.info);
    if (name == model.info.name || std::ranges::find(others, name) != others.end()) return &model;
  }
  return nullptr;
}

}  // namespace omma
