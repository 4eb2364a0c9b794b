// A camera: a centre and a bundle of rays, one or none for each point of its image.
//
// Camera frame: +X right, +Y up, looks along -Z. Image: pixels, origin at the top-left corner, x right, y down; the
// centre of the first pixel is (0.5, 0.5).
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "omma/base/limits.h"
#include "omma/camera/lens_model.h"
#include "omma/camera/pieces/piece_set.h"
#include "omma/math/ray.h"

namespace omma {

/// A smooth camera given by formulae: a model of models.def, its parameters, and the affine map from the model's plane
/// to pixels, pixel = centre + focal * plane.
struct Lens {
  const LensModel* model = nullptr;
  ImageSize size;
  glm::dvec2 focal{1.0};   ///< pixels per unit of the model's plane
  glm::dvec2 centre{0.0};  ///< principal point, pixels from the top-left corner
  LensParameters parameters;
  glm::dmat3 cameraFromLens{1.0};  ///< a rotation: the lens looks along its own -Z, turned within the camera
  friend bool operator==(const Lens&, const Lens&) = default;

  /// Pixel of a direction (any length) in the camera frame. Nothing when the lens does not see it.
  std::optional<glm::dvec2> project(const glm::dvec3& direction) const;
  /// Unit direction in the camera frame. Nothing where the image has no ray.
  std::optional<glm::dvec3> unproject(const glm::dvec2& pixel) const;
};

/// A camera given by a measured direction for each pixel's centre, in the camera frame. A zero direction is no ray.
struct RayMap {
  ImageSize size;
  std::vector<glm::vec3> directions;  ///< rows from the top; unit length or zero
  std::string source;                 ///< the file it was read from, if any

  /// Bilinear between pixel centres, and on to the image's edges; at a pixel's centre its own ray. Nothing outside the
  /// image, and nothing between pixels of which one has no ray.
  std::optional<glm::dvec3> unproject(const glm::dvec2& pixel) const;
};

class Camera {
 public:
  explicit Camera(Lens lens) : form_(std::move(lens)) {}
  explicit Camera(RayMap map) : form_(std::make_shared<const RayMap>(std::move(map))) {}
  explicit Camera(PieceSet pieces) : form_(std::make_shared<const PieceSet>(std::move(pieces))) {}

  ImageSize size() const;
  /// Exactly one of the three is not null.
  const Lens* lens() const { return std::get_if<Lens>(&form_); }
  const RayMap* ray_map() const;
  const PieceSet* pieces() const;
  /// What it is, for people: its lens's name, "ray map" or "pieces".
  const char* kind() const;

  /// Throws CommandError when the camera is a ray map: it has rays but no formula to project with.
  std::optional<glm::dvec2> project(const glm::dvec3& direction) const;
  /// In the camera frame.
  std::optional<Ray> unproject(const glm::dvec2& pixel) const;

  /// Pixels per radian around the image's centre, or the ray nearest to it, along the axis where they are denser: what
  /// other images are matched to. 0 when no pixel has a ray.
  double pixels_per_radian() const;

  /// Ray maps are equal when they are the same one, and so are pieces.
  friend bool operator==(const Camera&, const Camera&) = default;

 private:
  std::variant<Lens, std::shared_ptr<const RayMap>, std::shared_ptr<const PieceSet>> form_;
};

/// The camera of a text: `equidistant:fov_deg=180`, `opencv_fisheye:fx=…,fy=…,…`, or the name of a `.npy` file with
/// H x W x 3 directions, or a calibration file or one of pieces, `FILE` or `FILE#CAMERA` (docs/camera-files.md).
/// docs/cameras.md lists names and parameters.
///
/// `size` is the image asked for, if any. A camera with its own size (`width=`, `height=`) is scaled to it, which needs
/// the same shape; a ray map and pieces have the size they have. Without either the image is 1600 x 1200.
/// Throws CommandError for the text, InputError for a file, one beyond the limits too.
Camera make_camera(std::string_view text, std::optional<ImageSize> size = std::nullopt, const Limits& limits = {});

/// A text from which make_camera makes the same camera: focal lengths and principal point in pixels, image size, and
/// whatever differs from the lens's defaults; for a ray map or pieces their file. Throws CommandError where there is
/// none.
std::string to_text(const Camera& camera);

/// No image has more pixels along a side, nor more in all: colour in floats takes 12 GiB then.
inline constexpr int max_image_side = 65536;
inline constexpr int64_t max_image_pixels = int64_t{1} << 30;

/// Why there is no image of this size, and what is accepted; empty where there is.
std::string image_size_refusal(ImageSize size);

/// Throws CommandError with that reason. `what` begins the message.
void check_image_size(std::string_view what, ImageSize size);

/// The ray map of a `.npy` file (float32 or float64, H x W x 3, either byte order, C or Fortran order): for each
/// pixel's centre, rows from the top, a direction in the camera frame (x right, y up, looking along -z). Directions
/// need not be of unit length; zero or what is not finite means no ray. Throws InputError for any other content, and
/// for more than the limit's picture_pixels.
RayMap load_ray_map(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace omma
