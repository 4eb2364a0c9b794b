// The list of lenses and what is known of each: one file in models/, one line in models/models.def.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace omma {

/// A lens's own parameters (without focal length and principal point), in the order of its LensInfo.
struct LensParameters {
  static constexpr int max_count = 16;
  std::array<double, max_count> k{};
  double max_angle = 0.0;  ///< radians from the axis beyond which the camera sees nothing
};

/// Which extent of the image a field of view spans.
enum class Fit { width, height, shorter, longer, diagonal };

struct LensParameterInfo {
  const char* name;  ///< with its unit where it has one: `fov_deg`
  double default_value;
  double min, max;
  const char* description;
};

/// What a lens says of itself; everything printed about lenses comes from here.
struct LensInfo {
  const char* name;         ///< as on the command line
  const char* also;         ///< other names people know it by
  const char* formula;      ///< one line, r as a function of θ or x, y of longitude and latitude
  const char* source;       ///< paper, section or tool the formula comes from
  double default_fov_deg;   ///< 0: has no field of view of its own and needs a focal length
  double max_fov_deg;       ///< fields of view may come up to this
  bool max_fov_inclusive;   ///< or only below it
  Fit default_fit;          ///< which side fov_deg spans unless `fit=` says otherwise
  bool radial;              ///< symmetric about the axis: any fit makes sense
  std::span<const LensParameterInfo> parameters;
  /// Radians from the axis up to which the formula is defined for these parameters.
  double (*max_angle)(const LensParameters&);
};

/// A lens as functions. Both take and give the optical frame of the calibration literature (x right, y down, z
/// forward) and the model's plane (unit focal length, x right, y down); they return whether the result is valid.
struct LensModel {
  const LensInfo& info;
  bool (*project)(const LensParameters&, glm::dvec3 direction, glm::dvec2& plane);
  bool (*unproject)(const LensParameters&, glm::dvec2 plane, glm::dvec3& direction);
  /// The same formulae in single precision, as the GPU computes them.
  bool (*project_float)(const LensParameters&, glm::vec3 direction, glm::vec2& plane);
  bool (*unproject_float)(const LensParameters&, glm::vec2 plane, glm::vec3& direction);
};

/// Every lens, in the order of models.def.
std::span<const LensModel> lens_models();

/// Null when there is none of that name.
const LensModel* find_lens_model(std::string_view name);

}  // namespace omma
