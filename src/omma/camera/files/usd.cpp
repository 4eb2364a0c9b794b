// The omni:lensdistortion attributes of a USD camera, as JSON: one object of them, or an object of such objects.
//
// The top left corner is (0, 0), as in Omma; maxFov is the whole field in degrees. ftheta runs from the distance in
// pixels to the angle in radians (k0, which must be 0, … k4). kannalaBrandtK3 and radTanThinPrism have the names of
// Project Aria's models and coefficients, and no attribute of theirs is a focal length: it is that of the USD camera
// they are applied to, as Isaac Sim's set_kannala_brandt_properties takes it. Newton has another reading of
// kannalaBrandtK3, r = k0 θ + k1 θ³ + k2 θ⁵ + k3 θ⁷ in pixels; the two are told apart by the focal length. What the
// schema would fill in for a coefficient left away differs from 0, so none of theirs may be. lut is refused: its
// textures are no calibration.
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

// The attributes of one model of one camera.
class Attributes {
 public:
  Attributes(const DocumentNode& camera, const std::string& model)
      : camera_(camera), prefix_("omni:lensdistortion:" + model + ":") {}

  DocumentNode at(const std::string& key) const { return camera_.at(prefix_ + key); }
  double number(const std::string& key) const { return at(key).number(); }
  double number_or_zero(const std::string& key) const {
    const auto found = camera_.find(prefix_ + key);
    return found ? found->number() : 0.0;
  }
  std::vector<double> numbers(std::initializer_list<const char*> keys) const {
    std::vector<double> values;
    for (const char* key : keys) values.push_back(number(key));
    return values;
  }

 private:
  const DocumentNode& camera_;
  std::string prefix_;
};

// What the models of NVIDIA and Project Aria have in common.
Calibration nominal(const Attributes& attributes, const char* model) {
  constexpr double radians_per_degree = 3.14159265358979323846 / 180.0;
  Calibration calibration{.model = model,
                          .size = image_size(attributes.at("nominalWidth"), attributes.at("nominalHeight")),
                          .parameters = {}};
  const std::vector<double> centre = attributes.at("opticalCenter").numbers(2);
  calibration.centre = {centre[0], centre[1]};
  calibration.max_angle = 0.5 * attributes.number("maxFov") * radians_per_degree;
  return calibration;
}

Calibration ftheta(const Attributes& attributes) {
  Calibration calibration = nominal(attributes, "ftheta");
  if (const double k0 = attributes.number_or_zero("k0"); k0 != 0.0) {
    attributes.at("k0").fail("is {}; 0 is accepted", k0);
  }
  for (const char* key : {"k1", "k2", "k3", "k4"}) calibration.parameters.push_back(attributes.number_or_zero(key));
  calibration.parameters.insert(calibration.parameters.end(), {0.0, 1.0, 0.0, 0.0, 1.0});
  return calibration;
}

Calibration opencv(const Attributes& attributes, bool fisheye) {
  Calibration calibration{
      .model = fisheye ? "opencv_fisheye" : "opencv", .size = image_size(attributes.at("imageSize")), .parameters = {}};
  calibration.focal = {attributes.number("fx"), attributes.number("fy")};
  calibration.centre = {attributes.number("cx"), attributes.number("cy")};
  const std::vector<const char*> keys =
      fisheye ? std::vector<const char*>{"k1", "k2", "k3", "k4"}
              : std::vector<const char*>{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"};
  for (const char* key : keys) calibration.parameters.push_back(attributes.number_or_zero(key));
  return calibration;
}

// Pixels, from the focal length and the sensor's size in one unit; square pixels where only its width is given.
glm::dvec2 focal_length(const DocumentNode& camera, const ImageSize& size) {
  const double focal = camera.at("focalLength").number();
  const auto along = [&](const DocumentNode& aperture, int pixels) {
    if (!(aperture.number() > 0.0)) aperture.fail("is {}; a positive length is accepted", aperture.number());
    return focal / aperture.number() * pixels;
  };
  const double across = along(camera.at("horizontalAperture"), size.width);
  const auto height = camera.find("verticalAperture");
  return {across, height ? along(*height, size.height) : across};
}

// Beyond what a distortion's coefficient is; fewer pixels a radian than this are no camera.
constexpr double largest_coefficient = 10.0;

Calibration kannala_brandt(const DocumentNode& camera, const Attributes& attributes) {
  Calibration calibration = nominal(attributes, "opencv_fisheye");
  std::vector<double> k = attributes.numbers({"k0", "k1", "k2", "k3"});
  const bool pixels = k[0] > largest_coefficient;
  if (camera.has("focalLength")) {
    if (pixels) {
      attributes.at("k0").fail(
          "is {}: pixels per radian, and focalLength is given too; take that away, or give the coefficient of θ³, "
          "-10 to 10",
          k[0]);
    }
    calibration.focal = focal_length(camera, calibration.size);
    calibration.parameters = k;
  } else if (pixels) {
    calibration.focal = glm::dvec2(k[0]);
    calibration.parameters = {k[1] / k[0], k[2] / k[0], k[3] / k[0]};
  } else {
    camera.fail(
        "says no focal length: focalLength and horizontalAperture of the USD camera are expected, or a k0 in pixels "
        "per "
        "radian, more than 10");
  }
  return calibration;
}

Calibration rad_tan_thin_prism(const DocumentNode& camera, const Attributes& attributes) {
  Calibration calibration = nominal(attributes, "fisheye624");
  calibration.focal = focal_length(camera, calibration.size);
  calibration.parameters = attributes.numbers({"k0", "k1", "k2", "k3", "k4", "k5", "p0", "p1", "s0", "s1", "s2", "s3"});
  return calibration;
}

Calibration read_calibration(const DocumentNode& camera, const DocumentNode& model) {
  const std::string name = model.text();
  const Attributes attributes(camera, name);
  if (name == "ftheta") return ftheta(attributes);
  if (name == "opencvPinhole" || name == "opencvFisheye") return opencv(attributes, name == "opencvFisheye");
  if (name == "kannalaBrandtK3") return kannala_brandt(camera, attributes);
  if (name == "radTanThinPrism") return rad_tan_thin_prism(camera, attributes);
  if (name == "lut") {
    model.fail("'lut' is not supported: it is two textures of rays; a ray map (.npy) of the first is a camera");
  }
  fail_unknown(model, "model", name,
               {"ftheta", "kannalaBrandtK3", "radTanThinPrism", "opencvPinhole", "opencvFisheye"});
}

Camera read_camera(const DocumentNode& camera) {
  const DocumentNode model = camera.at(model_key);
  return to_camera(model.place(), read_calibration(camera, model));
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
    .models = "`ftheta`, `kannalaBrandtK3`, `radTanThinPrism`, `opencvPinhole`, `opencvFisheye`",
    .convention =
        "image's corner at (0, 0), as Omma's; ftheta from pixels to radians, maxFov the whole field in degrees; "
        "kannalaBrandtK3 (k0 … k3) and radTanThinPrism as Project Aria's, their focal length that of the USD camera, "
        "`focalLength` and `horizontalAperture`; without it k0 … k3 of kannalaBrandtK3 are pixels",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
