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
  std::array<double, max_count> k{};  ///< then what LensInfo::derive adds
  double max_angle = 0.0;             ///< radians from the axis beyond which the camera sees nothing
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
  const char* choices = nullptr;  ///< the names of its values 0, 1, …, separated by ", "; null: it is a number
};

/// Another name of a lens that also sets some of its parameters.
struct LensPreset {
  const char* name;
  const char* settings;  ///< as after the lens's name and colon on the command line
};

/// A rectangle of a lens's plane.
struct PlaneRectangle {
  glm::dvec2 min, max;
};

/// A convex polygon of a lens's plane, its corners clockwise as seen (y is down).
using PlanePolygon = std::vector<glm::dvec2>;

/// Squares two units wide around the plane's origin, in rows from the top left.
std::vector<PlanePolygon> plane_squares(int columns, int rows);

/// What a lens says of itself; everything printed about lenses comes from here.
struct LensInfo {
  const char* name;          ///< as on the command line
  const char* group;         ///< one of lens_groups: what kind of lens it is
  const char* also;          ///< other names that are understood, separated by ", "
  const char* formula;       ///< one line, r as a function of θ or x, y of longitude and latitude
  const char* source;        ///< paper, section or tool the formula comes from
  const char* example;       ///< a camera of this lens, all its parameters in use, as make_camera takes it
  double default_fov_deg;    ///< 0: none, a field of view or a focal length must be given
  double max_fov_deg;        ///< fields of view may come up to this, across the width where not radial; 0: it has none
  bool max_fov_inclusive;    ///< or only below it
  Fit default_fit;           ///< which side fov_deg spans unless `fit=` says otherwise
  bool radial;               ///< symmetric about the axis, but for what makes it skewed: any fit makes sense
  bool skewed = false;       ///< some parameters, 0 by default, break the symmetry: tangential, thin prism, tilt, shear
  bool plane_in_mm = false;  ///< the plane's unit is the millimetre of the sensor
  std::span<const LensParameterInfo> parameters;
  /// Radians from the axis up to which the formula is defined for these parameters.
  double (*max_angle)(const LensParameters&);
  /// What the formula needs and max_angle too, worked out once: entries of k after those of the parameters.
  void (*derive)(LensParameters&) = nullptr;
  std::span<const LensPreset> presets = {};
  /// The part of the plane that fills the image whatever the image's shape; nothing where a field of view or a focal
  /// length says what the image shows.
  std::optional<PlaneRectangle> (*frame)(const LensParameters&) = nullptr;
  /// Where the lens has folds or jumps: the parts of the plane within which it has none. Null: it is smooth.
  std::vector<PlanePolygon> (*parts)(const LensParameters&) = nullptr;
  /// The same formula with parameters that see up to so many radians further, where it goes on. Null: only max_angle
  /// ends what it sees.
  LensParameters (*widened)(const LensParameters&, double angle) = nullptr;
  /// What is wrong with parameters that are each within their range, with what is accepted; null when nothing is.
  const char* (*contradiction)(const LensParameters&) = nullptr;
};

/// Parameters with these values, in the order of `info.parameters` and the defaults for those that are left away, as
/// far as the formula is defined.
LensParameters lens_parameters(const LensInfo& info, std::span<const double> values = {});

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

/// The preset of that name, in upper or lower case; null when there is none.
const LensPreset* find_lens_preset(std::string_view name);

/// By its name, one of its other names or that of a preset, in upper or lower case; null when there is none.
const LensModel* find_lens_model(std::string_view name);

/// The names in `info.also`.
std::vector<std::string> other_names(const LensInfo& info);

/// The names of a parameter's values; none where it is a number.
std::vector<std::string> choices(const LensParameterInfo& parameter);

}  // namespace omma
