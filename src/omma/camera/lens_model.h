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
  friend bool operator==(const LensParameters&, const LensParameters&) = default;
};

/// Which extent of the image a field of view spans.
enum class Fit { width, height, shorter, longer, diagonal };

const char* fit_name(Fit fit);

/// The kinds of lenses, in the order in which they are listed.
inline constexpr std::array<const char*, 4> lens_groups = {"radial", "calibrated", "panoramic", "layout"};

struct LensParameterInfo {
  const char* name;
  double default_value;
  double min, max;
  const char* description;
};

/// What a lens says of itself; everything printed about lenses comes from here.
struct LensInfo {
  const char* name;        ///< as on the command line
  const char* group;       ///< one of lens_groups: what kind of lens it is
  const char* also;        ///< other names that are understood, separated by ", "
  const char* formula;     ///< one line, r as a function of θ or x, y of longitude and latitude
  const char* source;      ///< paper, section or tool the formula comes from
  const char* example;     ///< a camera of this lens, all its parameters in use, as make_camera takes it
  double default_fov_deg;  ///< 0: none, a field of view or a focal length must be given
  double max_fov_deg;      ///< fields of view may come up to this, across the width where not radial
  bool max_fov_inclusive;  ///< or only below it
  Fit default_fit;         ///< which side fov_deg spans unless `fit=` says otherwise
  bool radial;             ///< symmetric about the axis: any fit makes sense
  std::span<const LensParameterInfo> parameters;
  /// Radians from the axis up to which the formula is defined for these parameters.
  double (*max_angle)(const LensParameters&);
};

/// A lens as functions. Both take and give the optical frame of the calibration literature (x right, y down, z
/// forward) and the model's plane (unit focal length, x right, y down); they return whether the result is valid.
/// Directions given are finite and not zero, those returned are of unit length.
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

/// By its name or one of its other names; null when there is none.
const LensModel* find_lens_model(std::string_view name);

/// The names in `info.also`.
std::vector<std::string> other_names(const LensInfo& info);

}  // namespace omma
