#include "omma/camera/files/calibration.h"

#include <algorithm>
#include <cmath>

#include "omma/base/names.h"

namespace omma {
namespace {

bool model_is(const Lens& lens, std::string_view name) { return lens.model->info.name == name; }

}  // namespace

Camera to_camera(const Place& place, const Calibration& calibration) {
  const LensModel& model = *find_lens_model(calibration.model);
  const LensInfo& info = model.info;
  Lens lens;
  lens.model = &model;
  lens.size = calibration.size;
  lens.focal = calibration.focal;
  lens.centre = calibration.centre;
  for (const double focal : {lens.focal.x, lens.focal.y}) {
    if (!(focal >= 1e-3 && focal <= 1e9)) {
      place.fail("the focal length {} is out of range; 0.001 to 1e9 pixels is accepted", focal);
    }
  }
  const glm::dvec2 size(lens.size.width, lens.size.height);
  for (int axis = 0; axis < 2; ++axis) {
    if (!(lens.centre[axis] >= -size[axis] && lens.centre[axis] <= 2.0 * size[axis])) {
      place.fail("the principal point {}, {} lies far outside the image of {} x {}", lens.centre.x, lens.centre.y,
                 size.x, size.y);
    }
  }
  if (calibration.parameters.size() > info.parameters.size()) {
    place.fail("has {} coefficients; {} takes up to {}", calibration.parameters.size(), info.name,
               info.parameters.size());
  }
  for (size_t i = 0; i < calibration.parameters.size(); ++i) {
    const LensParameterInfo& parameter = info.parameters[i];
    const double value = calibration.parameters[i];
    if (!(value >= parameter.min && value <= parameter.max)) {
      place.fail("{} = {} is out of range; {} to {} is accepted", parameter.name, value, parameter.min, parameter.max);
    }
  }
  lens.parameters = lens_parameters(info, calibration.parameters);
  if (const char* contradiction = info.contradiction ? info.contradiction(lens.parameters) : nullptr) {
    place.fail("{}", contradiction);
  }
  if (!(lens.parameters.max_angle > 0.0)) {
    place.fail("with these coefficients the image's radius does not grow with the angle from the axis ({})",
               info.formula);
  }
  if (calibration.max_angle) {
    if (!(*calibration.max_angle > 0.0)) place.fail("the largest angle {} is not positive", *calibration.max_angle);
    lens.parameters.max_angle = std::min(lens.parameters.max_angle, *calibration.max_angle);
  }
  Camera camera(std::move(lens));
  if (!(camera.pixels_per_radian() > 0.0)) place.fail("the camera sees nothing: no pixel of its image has a ray");
  return camera;
}

Camera to_equirectangular(const Place& place, ImageSize size) {
  if (size.width != 2 * size.height) {
    place.fail("an equirectangular panorama is twice as wide as high, and this one has {} x {}", size.width,
               size.height);
  }
  return make_camera(fmt::format("equirectangular:width={},height={}", size.width, size.height));
}

bool is_whole_panorama(const Lens& lens) {
  if (!model_is(lens, "equirectangular") || lens.size.width != 2 * lens.size.height) return false;
  return lens == *to_equirectangular({}, lens.size).lens();
}

DocumentNode root_of(const Document& document) {
  return DocumentNode(std::shared_ptr<const Document>(std::shared_ptr<const Document>(), &document));
}

ImageSize image_size(const Place& place, double width, double height) {
  for (const double side : {width, height}) {
    if (!(side >= 1 && side <= max_image_side && side == std::floor(side))) {
      place.fail("{} pixels; 1 to {} is accepted", side, max_image_side);
    }
  }
  const ImageSize size{static_cast<int>(width), static_cast<int>(height)};
  if (const std::string why = image_size_refusal(size); !why.empty()) place.fail_with(why);
  return size;
}

ImageSize image_size(const DocumentNode& width, const DocumentNode& height) {
  const double across = static_cast<double>(width.integer()), down = static_cast<double>(height.integer());
  // Each side fails at its own place.
  image_size(width.place(), across, 1.0);
  return image_size(height.place(), across, down);
}

ImageSize image_size(const DocumentNode& both) {
  const std::vector<DocumentNode> sides = both.items();
  if (sides.size() != 2) both.fail("has {} numbers; width and height are expected", sides.size());
  return image_size(sides[0], sides[1]);
}

glm::dvec4 from_camera_matrix(const DocumentNode& node, const std::vector<double>& matrix) {
  if (matrix.size() != 9) node.fail("has {} numbers; 3 x 3 are expected", matrix.size());
  if (matrix[1] != 0.0) node.fail("has a skew of {}; 0 is accepted", matrix[1]);
  if (matrix[3] != 0.0 || matrix[6] != 0.0 || matrix[7] != 0.0 || matrix[8] != 1.0) {
    node.fail("is no camera matrix; fx, 0, cx, 0, fy, cy, 0, 0, 1 is expected");
  }
  return {matrix[0], matrix[4], matrix[2], matrix[5]};
}

std::vector<double> members(const DocumentNode& node, std::initializer_list<const char*> keys) {
  std::vector<double> values;
  for (const char* key : keys) values.push_back(node.at(key).number());
  return values;
}

std::vector<double> members_or_zero(const DocumentNode& node, std::initializer_list<const char*> keys) {
  std::vector<double> values;
  for (const char* key : keys) values.push_back(node.has(key) ? node.at(key).number() : 0.0);
  return values;
}

void fail_unknown(const DocumentNode& node, std::string_view what, std::string_view name,
                  const std::vector<std::string>& known) {
  node.place().fail_with(unknown_name(what, name.substr(0, 40), known));
}

std::optional<std::vector<double>> parameters_as(const Lens& lens, std::string_view model, size_t count) {
  if ((model_is(lens, "perspective") && model == "opencv") ||
      (model_is(lens, "equidistant") && model == "opencv_fisheye")) {
    return std::vector<double>(count, 0.0);
  }
  if (!model_is(lens, model)) return {};
  const auto& parameters = lens.model->info.parameters;
  for (size_t i = count; i < parameters.size(); ++i) {
    if (lens.parameters.k[i] != parameters[i].default_value) return {};
  }
  return std::vector<double>(lens.parameters.k.begin(), lens.parameters.k.begin() + static_cast<std::ptrdiff_t>(count));
}

void refuse_lens(const NamedCamera& camera, const char* format, std::string_view accepted) {
  const Lens* lens = camera.camera.lens();
  std::string values;
  if (lens) {
    const auto& parameters = lens->model->info.parameters;
    for (size_t i = 0; i < parameters.size(); ++i) {
      if (lens->parameters.k[i] != parameters[i].default_value) {
        values += fmt::format("{}{}", values.empty() ? " with " : ", ", parameters[i].name);
      }
    }
  }
  throw CommandError("{}: {} files have no place for {}{}; they hold {}: convert it with --model", camera.name, format,
                     camera.camera.kind(), values, accepted);
}

const Lens& lens_to_write(const NamedCamera& camera, const char* format) {
  const Lens* lens = camera.camera.lens();
  if (!lens) refuse_lens(camera, format, "lenses");
  if (lens->cameraFromLens != glm::dmat3(1.0)) {
    throw CommandError(
        "{}: {} files have no place for yaw_deg, pitch_deg and roll_deg; leave them away and turn the camera's pose",
        camera.name, format);
  }
  if (lens->parameters.max_angle < lens->model->info.max_angle(lens->parameters)) {
    warn(fmt::format("{}: {} files have no place for max_angle_deg: what is read back sees as far as its formula goes",
                     camera.name, format));
  }
  return *lens;
}

const NamedCamera& only_one(std::span<const NamedCamera> cameras, const char* format) {
  if (cameras.size() != 1) {
    throw CommandError("a file of the format {} holds one camera, and {} are to be written; choose one with FILE#NAME",
                       format, cameras.size());
  }
  return cameras.front();
}

std::string comma_separated(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += fmt::format("{}{}", text.empty() ? "" : ", ", number);
  return text;
}

}  // namespace omma
