#include "omma/camera/camera_parameters.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/math/heading.h"

namespace omma {
namespace {

constexpr CameraParameterInfo common_parameters[] = {
    {"fov_deg", "per lens",
     "field of view in degrees, of the extent of the image that `fit` names, the principal point in "
     "its middle"},
    {"fit", "per lens",
     "`width`, `height`, `shorter` (or `circle`), `longer`, or `diagonal` (or `full`; radial lenses "
     "only). With `shorter` a radial lens shows nothing beyond half of `fov_deg`: an image circle. "
     "With the others it fills the image as far as its formula goes"},
    {"f", "none", "focal length in pixels, instead of `fov_deg`"},
    {"fx, fy", "none", "horizontal and vertical focal length in pixels, instead of `f`"},
    {"f_mm", "none", "focal length in millimetres, instead of `f`; needs `sensor_mm`"},
    {"sensor_mm", "none",
     "width in millimetres of the sensor behind the whole image; alone where a lens's formula is in millimetres"},
    {"cx, cy", "middle", "principal point in pixels from the image's top left corner"},
    {"width, height", "the size asked for",
     "pixels; the image that the other values are for. Another size of the same shape scales them"},
    {"yaw_deg", "0", "degrees that the lens looks to the right of where the camera looks; within a whole turn"},
    {"pitch_deg", "0", "degrees that it then looks up; 90 for a dome's zenith"},
    {"roll_deg", "0", "degrees that it is then turned clockwise about its axis, as seen from behind"},
    {"max_angle_deg", "from `fit`", "degrees from the axis beyond which nothing is seen"},
};

struct FitName {
  const char* name;
  Fit fit;
};
constexpr FitName fit_names[] = {
    {"width", Fit::width},       {"height", Fit::height},  {"shorter", Fit::shorter}, {"longer", Fit::longer},
    {"diagonal", Fit::diagonal}, {"circle", Fit::shorter}, {"full", Fit::diagonal},
};

}  // namespace

std::span<const CameraParameterInfo> common_camera_parameters() { return common_parameters; }

Fit parse_fit(std::string_view what, std::string_view name) {
  const auto* found = std::ranges::find(fit_names, name, &FitName::name);
  if (found == std::end(fit_names)) {
    std::vector<std::string> choices;
    for (const FitName& choice : fit_names) choices.emplace_back(choice.name);
    throw CommandError("{}: {}", what, unknown_name("fit", name, choices));
  }
  return found->fit;
}

double half_extent(Fit fit, const ImageSize& size) {
  const double width = 0.5 * size.width, height = 0.5 * size.height;
  switch (fit) {
    case Fit::width:
      return width;
    case Fit::height:
      return height;
    case Fit::shorter:
      return std::min(width, height);
    case Fit::longer:
      return std::max(width, height);
    case Fit::diagonal:
      break;
  }
  return std::hypot(width, height);
}

glm::dmat3 lens_rotation(const std::function<double(const char* key, double limit)>& degrees) {
  constexpr double radians_per_degree = std::numbers::pi / 180.0;
  return rotation_of({.yaw = degrees("yaw_deg", 360.0) * radians_per_degree,
                      .pitch = degrees("pitch_deg", 180.0) * radians_per_degree,
                      .roll = degrees("roll_deg", 360.0) * radians_per_degree});
}

glm::dvec2 image_scale(std::string_view what, const ImageSize& own_size, const ImageSize& wanted_size) {
  const glm::dvec2 own(own_size.width, own_size.height), wanted(wanted_size.width, wanted_size.height);
  const bool same_shape =
      std::abs(wanted.y - wanted.x * own.y / own.x) <= 0.5 || std::abs(wanted.x - wanted.y * own.x / own.y) <= 0.5;
  if (!same_shape) {
    throw CommandError(
        "{} x {} are for an image of {} x {}, and {} x {} has another shape; ask for a size of the "
        "same shape, for example {} x {}",
        what, "height", own.x, own.y, wanted.x, wanted.y, wanted.x,
        std::max(1.0, std::round(wanted.x * own.y / own.x)));
  }
  return wanted / own;
}

}  // namespace omma
