// The omni:lensdistortion attributes of a USD camera, as JSON: one object of them, or an object of such objects.
//
// The top left corner is (0, 0), as in Omma. ftheta runs from the distance in pixels to the angle in radians (k0, which
// must be 0, … k4); maxFov is the whole field in degrees. kannalaBrandtK3, radTanThinPrism and lut are refused: their
// attributes say no focal length, or name textures.
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

constexpr const char* model_key = "omni:lensdistortion:model";

bool recognises(const Document& document) {
  if (document.syntax != Syntax::json) return false;
  const DocumentNode root = root_of(document);
  if (!root.is_map()) return false;
  if (root.has(model_key)) return true;
  for (const auto& [name, node] : root.members()) {
    if (node.has(model_key)) return true;
  }
  return false;
}

Camera read_camera(const DocumentNode& camera) {
  const DocumentNode model = camera.at(model_key);
  const std::string name = model.text();
  const auto at = [&](const std::string& key) { return camera.at("omni:lensdistortion:" + name + ":" + key); };
  const auto number_or_zero = [&](const std::string& key) {
    const auto found = camera.find("omni:lensdistortion:" + name + ":" + key);
    return found ? found->number() : 0.0;
  };
  Calibration calibration{.model = "", .size = {}, .parameters = {}};
  if (name == "ftheta") {
    constexpr double radians_per_degree = 3.14159265358979323846 / 180.0;
    calibration.model = "ftheta";
    calibration.size = image_size(at("nominalWidth"), at("nominalHeight"));
    const std::vector<double> centre = at("opticalCenter").numbers(2);
    calibration.centre = {centre[0], centre[1]};
    if (const double k0 = number_or_zero("k0"); k0 != 0.0) at("k0").fail("is {}; 0 is accepted", k0);
    for (const char* key : {"k1", "k2", "k3", "k4"}) calibration.parameters.push_back(number_or_zero(key));
    calibration.parameters.insert(calibration.parameters.end(), {0.0, 1.0, 0.0, 0.0, 1.0});
    calibration.max_angle = 0.5 * at("maxFov").number() * radians_per_degree;
  } else if (name == "opencvPinhole" || name == "opencvFisheye") {
    const bool fisheye = name == "opencvFisheye";
    calibration.model = fisheye ? "opencv_fisheye" : "opencv";
    calibration.size = image_size(at("imageSize"));
    calibration.focal = {at("fx").number(), at("fy").number()};
    calibration.centre = {at("cx").number(), at("cy").number()};
    const std::vector<const char*> keys =
        fisheye ? std::vector<const char*>{"k1", "k2", "k3", "k4"}
                : std::vector<const char*>{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"};
    for (const char* key : keys) calibration.parameters.push_back(number_or_zero(key));
  } else {
    fail_unknown(model, "model", name, {"ftheta", "opencvPinhole", "opencvFisheye"});
  }
  return to_camera(model.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  if (root.has(model_key)) return {{"camera", [root] { return read_camera(root); }}};
  std::vector<CameraFile::Entry> entries;
  for (const auto& [name, camera] : root.members()) {
    if (camera.has(model_key)) entries.push_back({name, [camera = camera] { return read_camera(camera); }});
  }
  return entries;
}

}  // namespace

const CameraFormat usd_format = {
    .name = "usd",
    .what = "USD `omni:lensdistortion:*` attributes (JSON)",
    .recognised = "`omni:lensdistortion:model`",
    .models = "`ftheta`, `opencvPinhole`, `opencvFisheye`",
    .convention =
        "image's corner at (0, 0), as Omma's; ftheta from pixels to radians, maxFov the whole field in degrees",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
