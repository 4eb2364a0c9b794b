// OpenCV's FileStorage in YAML, XML or JSON, as its calibration samples write it: camera_matrix,
// distortion_coefficients, image_width, image_height; fisheye_model: 1 for the fisheye module, xi for omnidir.
//
// The centre of the first pixel is (0, 0); x right, y down, z forward. Coefficients are k1 k2 p1 p2 [k3 [k4 k5 k6
// [s1 s2 s3 s4 [tau_x tau_y]]]], k1 k2 k3 k4 of the fisheye, k1 k2 p1 p2 of omnidir; radians.
#include <array>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

// The root, within <opencv_storage> in XML.
DocumentNode storage(const DocumentNode& root) { return root.find("opencv_storage").value_or(root); }

std::optional<DocumentNode> camera_matrix(const DocumentNode& root) {
  return root.find_any({"camera_matrix", "Camera_Matrix", "cameraMatrix", "CameraMatrix", "K"});
}

bool is_matrix(const DocumentNode& node) { return node.is_map() && node.has("data") && node.has("dt"); }

bool recognises(const Document& document) {
  if (document.syntax == Syntax::lines) return false;
  const DocumentNode root = storage(root_of(document));
  const std::optional<DocumentNode> matrix = camera_matrix(root);
  return matrix && is_matrix(*matrix) && !root.has("distortion_model");
}

std::vector<double> matrix_values(const DocumentNode& node) {
  if (!node.is_map()) return node.numbers();
  const long rows = node.at("rows").integer(), columns = node.at("cols").integer();
  const DocumentNode data = node.at("data");
  std::vector<double> values = data.numbers();
  if (rows < 0 || columns < 0 || values.size() != static_cast<size_t>(rows) * static_cast<size_t>(columns)) {
    data.fail("has {} numbers; {} x {} are expected", values.size(), rows, columns);
  }
  return values;
}

ImageSize size_of(const DocumentNode& root) {
  if (const auto both = root.find_any({"image_size", "imageSize", "Image_Size"})) {
    if (both->is_list()) return image_size(*both);
    const std::vector<double> sides = both->numbers(2);
    return image_size(both->place(), sides[0], sides[1]);
  }
  const auto width = root.find_any({"image_width", "Image_Width", "imageWidth", "width"});
  const auto height = root.find_any({"image_height", "Image_Height", "imageHeight", "height"});
  if (!width || !height) {
    root.fail("'{}' is missing; the size of the image that was calibrated is needed",
              width ? "image_height" : "image_width");
  }
  return image_size(*width, *height);
}

// OpenCV's four coefficients are those of either of two models; no file says which but by a flag.
bool is_fisheye(const DocumentNode& root, const DocumentNode& coefficients, size_t count) {
  if (const auto flag = root.find_any({"fisheye_model", "fisheye"})) return flag->boolean();
  if (count == 4) {
    coefficients.fail(
        "four coefficients are k1 k2 p1 p2 of a pinhole or k1 k2 k3 k4 of a fisheye, and nothing says which; add "
        "fisheye_model: 0 or fisheye_model: 1");
  }
  return false;
}

Camera read_camera(const DocumentNode& root) {
  const DocumentNode matrix = *camera_matrix(root);
  const glm::dvec4 intrinsics = from_camera_matrix(matrix, matrix_values(matrix));
  Calibration calibration{.model = "opencv", .size = size_of(root), .parameters = {}};
  calibration.focal = {intrinsics.x, intrinsics.y};
  calibration.centre = glm::dvec2(intrinsics.z, intrinsics.w) + centre_of_first_pixel;
  const auto coefficients = root.find_any({"distortion_coefficients", "Distortion_Coefficients",
                                           "distortionCoefficients", "distCoeffs", "dist_coeffs", "D"});
  if (!coefficients) root.fail("'distortion_coefficients' is missing");
  calibration.parameters = matrix_values(*coefficients);
  const size_t count = calibration.parameters.size();
  if (const auto xi = root.find("xi")) {
    if (count != 4) coefficients->fail("has {} numbers; with xi, k1 k2 p1 p2 are expected", count);
    const std::vector<double> value = matrix_values(*xi);
    if (value.size() != 1) xi->fail("has {} numbers; one is expected", value.size());
    calibration.model = "mei";
    calibration.parameters.insert(calibration.parameters.begin(), value.front());
  } else if (is_fisheye(root, *coefficients, count)) {
    if (count != 4) coefficients->fail("has {} numbers; a fisheye has k1 k2 k3 k4", count);
    calibration.model = "opencv_fisheye";
  } else if (count != 4 && count != 5 && count != 8 && count != 12 && count != 14) {
    coefficients->fail("has {} numbers; 4, 5, 8, 12 or 14 are expected", count);
  }
  return to_camera(matrix.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root = storage(DocumentNode(document));
  std::string name = "camera";
  if (const auto given = root.find("camera_name")) name = given->text();
  return {{name, [root] { return read_camera(root); }}};
}

std::string matrix_text(const char* name, size_t rows, size_t columns, std::span<const double> values) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name, rows, columns,
                     comma_separated(values));
}

std::string write(std::span<const NamedCamera> cameras) {
  const NamedCamera& camera = only_one(cameras, opencv_format.name);
  const Lens& lens = lens_to_write(camera, opencv_format.name);
  std::optional<std::vector<double>> coefficients;
  std::string what = "fisheye_model: 0\n";
  if (auto mei = parameters_as(lens, "mei", 5)) {
    what = matrix_text("xi", 1, 1, std::span(*mei).first(1));
    coefficients.emplace(mei->begin() + 1, mei->end());
  } else if ((coefficients = parameters_as(lens, "opencv_fisheye", 4))) {
    what = "fisheye_model: 1\n";
  } else {
    for (const size_t count : {5, 8, 12, 14}) {
      if (!coefficients) coefficients = parameters_as(lens, "opencv", count);
    }
  }
  if (!coefficients) refuse_lens(camera, opencv_format.name, "perspective, opencv, opencv_fisheye and mei");
  const glm::dvec2 centre = lens.centre - centre_of_first_pixel;
  const std::array<double, 9> matrix = {lens.focal.x, 0, centre.x, 0, lens.focal.y, centre.y, 0, 0, 1};
  return fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n{}{}{}", lens.size.width, lens.size.height,
                     what, matrix_text("camera_matrix", 3, 3, matrix),
                     matrix_text("distortion_coefficients", coefficients->size(), 1, *coefficients));
}

}  // namespace

const CameraFormat opencv_format = {
    .name = "opencv",
    .what = "OpenCV FileStorage (YAML, XML, JSON)",
    .recognised = "`camera_matrix` that is a matrix with `dt`, and no `distortion_model`",
    .models = "pinhole with 4, 5, 8, 12 or 14 coefficients; `fisheye_model: 1`: fisheye; `xi`: omnidir",
    .convention = "first pixel's centre at (0, 0); k1 k2 p1 p2 k3 …; radians; four coefficients need `fisheye_model`",
    .recognises = recognises,
    .read = read,
    .extension = ".yaml",
    .write = write,
};

}  // namespace omma
