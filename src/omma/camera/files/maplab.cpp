// maplab's sensors: cameras within a sensor of the type NCAMERA, or a rig's list of cameras alone. They are named cam0,
// cam1, … in the file's order. Poses and other sensors are not read.
//
// The centre of the first pixel is (0, 0); x right, y down, z forward. Intrinsics fu fv cu cv, xi first with
// unified-projection. Distortion: radtan k1 k2 p1 p2; equidistant k1 k2 k3 k4; fisheye is the field-of-view model's w.
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

struct Model {
  const char* type;
  const char* distortion;
  const char* lens;
  size_t own;     ///< numbers before fu in the intrinsics
  size_t coeffs;  ///< numbers of the distortion
};

constexpr Model models[] = {
    {"pinhole", "none", "perspective", 0, 0},           {"pinhole", "radtan", "opencv", 0, 4},
    {"pinhole", "equidistant", "opencv_fisheye", 0, 4}, {"pinhole", "fisheye", "fov", 0, 1},
    {"unified-projection", "none", "mei", 1, 0},        {"unified-projection", "radtan", "mei", 1, 4},
};

// The list of cameras within this, if it is a rig.
std::optional<DocumentNode> rig(const DocumentNode& node) {
  const auto cameras = node.find("cameras");
  return cameras && cameras->is_list() ? cameras : std::nullopt;
}

bool recognises(const Document& document) {
  if (document.syntax != Syntax::yaml) return false;
  const DocumentNode root = root_of(document);
  if (rig(root)) return true;
  const auto sensors = root.find("sensors");
  return sensors && sensors->is_list();
}

Camera read_camera(const DocumentNode& camera) {
  const DocumentNode type = camera.at("type"), intrinsics = camera.at("intrinsics").at("data");
  const auto distortion = camera.find("distortion");
  const std::string distortion_name = distortion ? distortion->at("type").text() : "none";
  const Model* found = nullptr;
  std::vector<std::string> known;
  for (const Model& model : models) {
    known.push_back(fmt::format("{} with {}", model.type, model.distortion));
    if (type.text() == model.type && distortion_name == model.distortion) found = &model;
  }
  if (!found) fail_unknown(type, "model", fmt::format("{} with {}", type.text(), distortion_name), known);
  Calibration calibration{
      .model = found->lens, .size = image_size(camera.at("image_width"), camera.at("image_height")), .parameters = {}};
  const std::vector<double> values = intrinsics.numbers(found->own + 4);
  const auto f = values.begin() + static_cast<std::ptrdiff_t>(found->own);
  calibration.parameters.assign(values.begin(), f);
  calibration.focal = {f[0], f[1]};
  calibration.centre = glm::dvec2(f[2], f[3]) + centre_of_first_pixel;
  if (found->coeffs > 0) {
    const std::vector<double> coefficients = distortion->at("parameters").at("data").numbers(found->coeffs);
    calibration.parameters.insert(calibration.parameters.end(), coefficients.begin(), coefficients.end());
  }
  return to_camera(intrinsics.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  std::vector<DocumentNode> rigs = {root};
  if (const auto sensors = root.find("sensors")) rigs = sensors->items();
  std::vector<CameraFile::Entry> entries;
  for (const DocumentNode& node : rigs) {
    const auto cameras = rig(node);
    if (!cameras) continue;
    for (const DocumentNode& item : cameras->items()) {
      const DocumentNode camera = item.at("camera");
      entries.push_back({fmt::format("cam{}", entries.size()), [camera] { return read_camera(camera); }});
    }
  }
  return entries;
}

}  // namespace

const CameraFormat maplab_format = {
    .name = "maplab",
    .what = "maplab sensors (YAML)",
    .recognised = "a list `sensors`, or a list `cameras`",
    .models = "pinhole with none, radtan, equidistant or fisheye (FOV); unified-projection",
    .convention = "first pixel's centre at (0, 0); fu fv cu cv; cameras are cam0, cam1, … in the file's order",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
