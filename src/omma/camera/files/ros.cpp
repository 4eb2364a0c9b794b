// ROS camera_info, as camera_calibration writes it (camera_matrix, distortion_model, distortion_coefficients) or as the
// message is printed (K, distortion_model, D). K and D are read; rectification and projection matrices are not.
//
// The centre of the first pixel is (0, 0); x right, y down, z forward. plumb_bob: k1 k2 p1 p2 k3; rational_polynomial:
// and k4 k5 k6; equidistant: k1 k2 k3 k4 of OpenCV's fisheye.
#include <fmt/format.h>

#include <array>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

struct Model {
  const char* name;
  const char* lens;
  std::vector<size_t> counts;
};

const std::vector<Model>& models() {
  static const std::vector<Model> list = {
      {"plumb_bob", "opencv", {5, 4, 0}},
      {"rational_polynomial", "opencv", {8, 12, 14}},
      {"equidistant", "opencv_fisheye", {4}},
  };
  return list;
}

std::optional<DocumentNode> camera_matrix(const DocumentNode& root) {
  return root.find_any({"camera_matrix", "K", "k"});
}

bool recognises(const Document& document) {
  if (document.syntax != Syntax::yaml && document.syntax != Syntax::json) return false;
  const DocumentNode root = root_of(document);
  return root.has("distortion_model") && camera_matrix(root);
}

std::vector<double> matrix_values(const DocumentNode& node, size_t rows) {
  if (!node.is_map()) return node.numbers();
  const std::vector<double> values = node.at("data").numbers();
  const long given_rows = node.at("rows").integer(), columns = node.at("cols").integer();
  if (given_rows != static_cast<long>(rows) || columns < 0 || values.size() != rows * static_cast<size_t>(columns)) {
    node.fail("has {} numbers in {} rows of {}; {} rows are expected", values.size(), given_rows, columns, rows);
  }
  return values;
}

// K is for the whole image; what a message crops or bins is another one.
void refuse_part_of_image(const DocumentNode& root) {
  for (const char* key : {"binning_x", "binning_y"}) {
    if (const auto binning = root.find(key); binning && binning->integer() > 1) {
      binning->fail("{} is not supported; 0 or 1 is accepted", binning->integer());
    }
  }
  if (const auto roi = root.find("roi"); roi && roi->is_map()) {
    for (const auto& [name, value] : roi->members()) {
      if (name != "do_rectify" && value.integer() != 0) value.fail("a region of interest is not supported");
    }
  }
}

Camera read_camera(const DocumentNode& root) {
  refuse_part_of_image(root);
  const DocumentNode name = root.at("distortion_model");
  std::vector<std::string> known;
  const Model* model = nullptr;
  for (const Model& candidate : models()) {
    known.emplace_back(candidate.name);
    if (name.text() == candidate.name) model = &candidate;
  }
  if (!model) fail_unknown(name, "distortion model", name.text(), known);
  const DocumentNode matrix = *camera_matrix(root);
  const glm::dvec4 intrinsics = from_camera_matrix(matrix, matrix_values(matrix, 3));
  Calibration calibration{.model = model->lens, .size = {}, .parameters = {}};
  const auto width = root.find_any({"image_width", "width"}), height = root.find_any({"image_height", "height"});
  if (!width || !height) root.fail("'{}' is missing", width ? "image_height" : "image_width");
  calibration.size = image_size(*width, *height);
  calibration.focal = {intrinsics.x, intrinsics.y};
  calibration.centre = glm::dvec2(intrinsics.z, intrinsics.w) + centre_of_first_pixel;
  const auto coefficients = root.find_any({"distortion_coefficients", "D", "d"});
  if (!coefficients) root.fail("'distortion_coefficients' is missing");
  calibration.parameters = matrix_values(*coefficients, 1);
  const size_t count = calibration.parameters.size();
  if (std::find(model->counts.begin(), model->counts.end(), count) == model->counts.end()) {
    coefficients->fail("has {} numbers; {} takes {}", count, model->name, fmt::join(model->counts, " or "));
  }
  return to_camera(matrix.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  std::string name = "camera";
  if (const auto given = root.find("camera_name")) name = given->text();
  return {{name, [root] { return read_camera(root); }}};
}

std::string matrix_text(const char* name, size_t rows, size_t columns, std::span<const double> values) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: [{}]\n", name, rows, columns, comma_separated(values));
}

std::string write(std::span<const NamedCamera> cameras) {
  const NamedCamera& camera = only_one(cameras, ros_format.name);
  const Lens& lens = lens_to_write(camera, ros_format.name);
  const char* model = "plumb_bob";
  std::optional<std::vector<double>> coefficients = parameters_as(lens, "opencv", 5);
  if (!coefficients && (coefficients = parameters_as(lens, "opencv", 8))) model = "rational_polynomial";
  if (!coefficients && (coefficients = parameters_as(lens, "opencv_fisheye", 4))) model = "equidistant";
  if (!coefficients) {
    refuse_lens(camera, ros_format.name, "perspective, opencv with up to eight coefficients, and opencv_fisheye");
  }
  const glm::dvec2 f = lens.focal, c = lens.centre - centre_of_first_pixel;
  const std::array<double, 9> matrix = {f.x, 0, c.x, 0, f.y, c.y, 0, 0, 1};
  const std::array<double, 9> identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::array<double, 12> projection = {f.x, 0, c.x, 0, 0, f.y, c.y, 0, 0, 0, 1, 0};
  return fmt::format("image_width: {}\nimage_height: {}\ncamera_name: \"{}\"\n", lens.size.width, lens.size.height,
                     camera.name) +
         matrix_text("camera_matrix", 3, 3, matrix) + fmt::format("distortion_model: {}\n", model) +
         matrix_text("distortion_coefficients", 1, coefficients->size(), *coefficients) +
         matrix_text("rectification_matrix", 3, 3, identity) + matrix_text("projection_matrix", 3, 4, projection);
}

}  // namespace

const CameraFormat ros_format = {
    .name = "ros",
    .what = "ROS camera_info (YAML)",
    .recognised = "`distortion_model` beside `camera_matrix` or `K`",
    .models = "`plumb_bob`, `rational_polynomial`, `equidistant`",
    .convention = "first pixel's centre at (0, 0); k1 k2 p1 p2 k3 …; equidistant: k1 … k4; no binning, no region",
    .recognises = recognises,
    .read = read,
    .extension = ".yaml",
    .write = write,
};

}  // namespace omma
