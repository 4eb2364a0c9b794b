// stella_vslam's configuration (OpenVSLAM's too): the group Camera, or keys that begin with `Camera.`.
//
// The centre of the first pixel is (0, 0), as in OpenCV; x right, y down, z forward. perspective: k1 k2 p1 p2 k3;
// fisheye: k1 k2 k3 k4 of OpenCV's; radial_division: distortion, of r².
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

bool recognises(const Document& document) {
  if (document.syntax != Syntax::yaml) return false;
  const DocumentNode root = root_of(document);
  const auto camera = root.find("Camera");
  return root.has("Camera.model") || (camera && camera->has("model"));
}

struct CameraKeys {
  DocumentNode root;
  DocumentNode at(const std::string& key) const {
    const auto group = root.find("Camera");
    return group ? group->at(key) : root.at("Camera." + key);
  }
};

Camera read_camera(const DocumentNode& root) {
  const CameraKeys keys{root};
  const DocumentNode model = keys.at("model");
  const std::string name = model.text();
  const ImageSize size = image_size(keys.at("cols"), keys.at("rows"));
  if (name == "equirectangular") return to_equirectangular(model.place(), size);
  Calibration calibration{.model = "", .size = size, .parameters = {}};
  std::vector<const char*> coefficients;
  if (name == "perspective") {
    calibration.model = "opencv";
    coefficients = {"k1", "k2", "p1", "p2", "k3"};
  } else if (name == "fisheye") {
    calibration.model = "opencv_fisheye";
    coefficients = {"k1", "k2", "k3", "k4"};
  } else if (name == "radial_division") {
    calibration.model = "division";
    coefficients = {"distortion"};
  } else {
    fail_unknown(model, "model", name, {"perspective", "fisheye", "radial_division", "equirectangular"});
  }
  calibration.focal = {keys.at("fx").number(), keys.at("fy").number()};
  calibration.centre = glm::dvec2(keys.at("cx").number(), keys.at("cy").number()) + centre_of_first_pixel;
  for (const char* key : coefficients) calibration.parameters.push_back(keys.at(key).number());
  return to_camera(model.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  return {{"camera", [root] { return read_camera(root); }}};
}

}  // namespace

const CameraFormat stella_format = {
    .name = "stella",
    .what = "stella_vslam, OpenVSLAM configuration (YAML)",
    .recognised = "`Camera` with `model`, or `Camera.model`",
    .models = "`perspective`, `fisheye`, `radial_division`, `equirectangular`",
    .convention = "first pixel's centre at (0, 0); named numbers, OpenCV's",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
