// Basalt's calibration.json: a list of intrinsics and a list of resolutions. Poses, IMU and vignettes are not read and
// not written: what is written has identity poses.
//
// The centre of the first pixel is (0, 0); x right, y down, z forward. All numbers have names. fov's w is in radians;
// pinhole-radtan8 is valid up to the radius rpmax before distortion where that is positive.
#include <cmath>
#include <nlohmann/json.hpp>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

using Json = nlohmann::ordered_json;

struct Model {
  const char* type;
  const char* lens;
  std::vector<const char*> parameters;  ///< in the order of the lens
};

const std::vector<Model>& models() {
  static const std::vector<Model> list = {
      {"pinhole", "perspective", {}},
      {"kb4", "opencv_fisheye", {"k1", "k2", "k3", "k4"}},
      {"ucm", "eucm", {"alpha"}},
      {"eucm", "eucm", {"alpha", "beta"}},
      {"ds", "double_sphere", {"xi", "alpha"}},
      {"fov", "fov", {"w"}},
      {"pinhole-radtan8", "opencv", {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
  };
  return list;
}

bool recognises(const Document& document) {
  if (document.syntax != Syntax::json) return false;
  const DocumentNode root = root_of(document);
  const auto calibration = root.find("value0");
  return calibration && calibration->has("intrinsics");
}

Camera read_camera(const DocumentNode& camera, const DocumentNode& resolution) {
  const DocumentNode type = camera.at("camera_type"), intrinsics = camera.at("intrinsics");
  const Model* found = nullptr;
  std::vector<std::string> known;
  for (const Model& model : models()) {
    known.emplace_back(model.type);
    if (type.text() == model.type) found = &model;
  }
  if (!found) fail_unknown(type, "camera type", type.text(), known);
  Calibration calibration{.model = found->lens, .size = image_size(resolution), .parameters = {}};
  for (const char* name : found->parameters) calibration.parameters.push_back(intrinsics.at(name).number());
  calibration.focal = {intrinsics.at("fx").number(), intrinsics.at("fy").number()};
  calibration.centre = glm::dvec2(intrinsics.at("cx").number(), intrinsics.at("cy").number()) + centre_of_first_pixel;
  if (const auto radius = intrinsics.find("rpmax"); radius && radius->number() > 0.0) {
    calibration.max_angle = std::atan(radius->number());
  }
  return to_camera(intrinsics.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root = DocumentNode(document).at("value0");
  const std::vector<DocumentNode> cameras = root.at("intrinsics").items(), sizes = root.at("resolution").items();
  if (cameras.size() != sizes.size()) {
    root.at("resolution").fail("has {} entries for {} cameras", sizes.size(), cameras.size());
  }
  std::vector<CameraFile::Entry> entries;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const DocumentNode camera = cameras[i], size = sizes[i];
    entries.push_back({fmt::format("cam{}", i), [camera, size] { return read_camera(camera, size); }});
  }
  return entries;
}

std::string write(std::span<const NamedCamera> cameras) {
  Json poses = Json::array(), intrinsics = Json::array(), sizes = Json::array();
  for (const NamedCamera& camera : cameras) {
    const Lens& lens = lens_to_write(camera, basalt_format.name);
    const glm::dvec2 centre = lens.centre - centre_of_first_pixel;
    Json numbers{{"fx", lens.focal.x}, {"fy", lens.focal.y}, {"cx", centre.x}, {"cy", centre.y}};
    const char* type = nullptr;
    for (const Model& model : models()) {
      const auto values = parameters_as(lens, model.lens, model.parameters.size());
      if (type || !values) continue;
      type = model.type;
      for (size_t i = 0; i < values->size(); ++i) numbers[model.parameters[i]] = (*values)[i];
      if (std::string_view(type) == "pinhole-radtan8") numbers["rpmax"] = 0.0;
    }
    if (!type) {
      refuse_lens(camera, basalt_format.name,
                  "perspective, opencv with up to eight coefficients, opencv_fisheye, fov, eucm and double_sphere");
    }
    poses.push_back({{"px", 0.0}, {"py", 0.0}, {"pz", 0.0}, {"qx", 0.0}, {"qy", 0.0}, {"qz", 0.0}, {"qw", 1.0}});
    intrinsics.push_back({{"camera_type", type}, {"intrinsics", numbers}});
    sizes.push_back({lens.size.width, lens.size.height});
  }
  return Json{{"value0", {{"T_imu_cam", poses}, {"intrinsics", intrinsics}, {"resolution", sizes}}}}.dump(4) + "\n";
}

}  // namespace

const CameraFormat basalt_format = {
    .name = "basalt",
    .what = "Basalt calibration (JSON)",
    .recognised = "`value0` with `intrinsics`",
    .models = "`pinhole`, `pinhole-radtan8`, `kb4`, `ucm`, `eucm`, `ds`, `fov`",
    .convention = "first pixel's centre at (0, 0); named numbers; written without IMU, with identity poses",
    .recognises = recognises,
    .read = read,
    .extension = ".json",
    .write = write,
};

}  // namespace omma
