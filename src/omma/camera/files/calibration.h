// Between a file's numbers and a camera: what all readers and writers share.
#pragma once

#include <optional>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/files/document.h"

namespace omma {

/// OpenCV and those who follow it put the centre of the first pixel at (0, 0), Omma its corner.
inline constexpr glm::dvec2 centre_of_first_pixel{0.5, 0.5};

/// A camera as calibration files hold it.
struct Calibration {
  const char* model;                               ///< of models.def
  ImageSize size;                                  ///< pixels
  glm::dvec2 focal{1.0};                           ///< pixels; 1 where the coefficients are for pixels
  glm::dvec2 centre{0.0};                          ///< pixels from the top left corner
  std::vector<double> parameters;                  ///< in the model's order; those left away have their defaults
  std::optional<double> max_angle = std::nullopt;  ///< radians from the axis
};

/// Throws InputError at `place` for what makes no camera: values out of range or contradicting each other, a principal
/// point more than an image's size outside the image.
Camera to_camera(const Place& place, const Calibration& calibration);

/// A whole panorama.
Camera to_equirectangular(const Place& place, ImageSize size);
bool is_whole_panorama(const Lens& lens);

/// The root of a document that outlives it.
DocumentNode root_of(const Document& document);

/// Two numbers as an image's size; fails at `place` unless they are whole and there are such images.
ImageSize image_size(const Place& place, double width, double height);

ImageSize image_size(const DocumentNode& width, const DocumentNode& height);
/// [width, height]
ImageSize image_size(const DocumentNode& both);

/// fx, fy, cx, cy of a 3 x 3 matrix, rows first. Fails for skew and for what is no such matrix.
glm::dvec4 from_camera_matrix(const DocumentNode& node, const std::vector<double>& matrix);

/// The values of these members, in this order.
std::vector<double> members(const DocumentNode& node, std::initializer_list<const char*> keys);

/// Those that are there; 0 for the others.
std::vector<double> members_or_zero(const DocumentNode& node, std::initializer_list<const char*> keys);

/// Fails at `node` saying what a name is unknown as, and the nearest of the known ones.
[[noreturn]] void fail_unknown(const DocumentNode& node, std::string_view what, std::string_view name,
                               const std::vector<std::string>& known);

/// A lens's parameters as the first `count` of another model that draws the same, its own included; nothing where it
/// needs more. A perspective camera is an opencv one without distortion, an equidistant one an opencv_fisheye.
std::optional<std::vector<double>> parameters_as(const Lens& lens, std::string_view model, size_t count);

/// Throws CommandError: the format has no place for this lens; what it has, and how to get there.
[[noreturn]] void refuse_lens(const NamedCamera& camera, const char* format, std::string_view accepted);

/// The lens, with a warning when the file will lose the angle at which it ends.
const Lens& lens_to_write(const NamedCamera& camera, const char* format);

/// CommandError unless there is exactly one.
const NamedCamera& only_one(std::span<const NamedCamera> cameras, const char* format);

/// "1.5, 2, 3", each number so that reading it gives the same again.
std::string comma_separated(std::span<const double> numbers);

}  // namespace omma
