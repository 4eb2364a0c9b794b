// camodocal's cameras (VINS-Fusion, KITTI-360): model_type and groups of named numbers.
//
// The centre of the first pixel is (0, 0); x right, y down, z forward. MEI has the focal lengths of the unified model
// (gamma1, gamma2), xi, and k1 k2 p1 p2; KANNALA_BRANDT counts k2 … k5 (of θ³, θ⁵, θ⁷, θ⁹) and calls focal lengths and
// centre mu mv u0 v0.
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

bool recognises(const Document& document) {
  if (document.syntax == Syntax::lines) return false;
  const DocumentNode root = root_of(document);
  return root.has("model_type");
}

Camera read_camera(const DocumentNode& root) {
  Calibration calibration{
      .model = "", .size = image_size(root.at("image_width"), root.at("image_height")), .parameters = {}};
  const DocumentNode type = root.at("model_type"), projection = root.at("projection_parameters");
  std::vector<double> intrinsics;
  if (type.text() == "MEI") {
    calibration.model = "mei";
    intrinsics = members(projection, {"gamma1", "gamma2", "u0", "v0"});
    calibration.parameters = members(root.at("distortion_parameters"), {"k1", "k2", "p1", "p2"});
    const double xi = root.at("mirror_parameters").at("xi").number();
    calibration.parameters.insert(calibration.parameters.begin(), xi);
  } else if (type.text() == "PINHOLE") {
    calibration.model = "opencv";
    intrinsics = members(projection, {"fx", "fy", "cx", "cy"});
    calibration.parameters = members(root.at("distortion_parameters"), {"k1", "k2", "p1", "p2"});
  } else if (type.text() == "KANNALA_BRANDT") {
    calibration.model = "opencv_fisheye";
    intrinsics = members(projection, {"mu", "mv", "u0", "v0"});
    calibration.parameters = members(projection, {"k2", "k3", "k4", "k5"});
  } else {
    fail_unknown(type, "model", type.text(), {"MEI", "PINHOLE", "KANNALA_BRANDT"});
  }
  calibration.focal = {intrinsics[0], intrinsics[1]};
  calibration.centre = glm::dvec2(intrinsics[2], intrinsics[3]) + centre_of_first_pixel;
  return to_camera(projection.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  const auto name = root.find("camera_name");
  return {{name ? name->text() : "camera", [root] { return read_camera(root); }}};
}

}  // namespace

const CameraFormat camodocal_format = {
    .name = "camodocal",
    .what = "camodocal: VINS-Fusion, KITTI-360 (YAML)",
    .recognised = "`model_type`",
    .models = "`MEI`, `PINHOLE`, `KANNALA_BRANDT`",
    .convention = "first pixel's centre at (0, 0); KANNALA_BRANDT counts its coefficients k2 … k5",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
