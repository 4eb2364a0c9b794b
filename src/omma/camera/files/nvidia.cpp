// NVIDIA's sensor rigs in JSON (NCore, gsplat): cameras by name, each with camera_model_type, resolution, intrinsics.
// A camera behind a windshield (external_distortion) is refused. Poses and shutters are not read.
//
// ftheta puts the centre of the first pixel at (0, 0), as NCore documents; the opencv models its corner. Polynomials
// are lowest coefficient first, radians and pixels; reference_poly says which of the two is the camera and which its
// approximate inverse: 1 pixeldist_to_angle, 2 angle_to_pixeldist. linear_cde is c, d, e.
#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

bool is_camera(const DocumentNode& node) { return node.has("camera_model_type") && node.has("intrinsics"); }

bool recognises(const Document& document) {
  if (document.syntax != Syntax::json) return false;
  const DocumentNode root = root_of(document);
  if (!root.is_map()) return false;
  if (is_camera(root)) return true;
  for (const auto& [name, node] : root.members()) {
    if (is_camera(node)) return true;
  }
  return false;
}

void append(std::vector<double>& to, std::span<const double> values) {
  for (const double value : values) to.push_back(value);
}

std::vector<double> ftheta_parameters(const DocumentNode& intrinsics) {
  const DocumentNode reference = intrinsics.at("reference_poly");
  const std::string which = reference.text();
  const bool from_distance = which == "1" || which == "PIXELDIST_TO_ANGLE";
  if (!from_distance && which != "2" && which != "ANGLE_TO_PIXELDIST") {
    fail_unknown(reference, "reference polynomial", which, {"1", "2", "PIXELDIST_TO_ANGLE", "ANGLE_TO_PIXELDIST"});
  }
  const DocumentNode polynomial = intrinsics.at(from_distance ? "pixeldist_to_angle_poly" : "angle_to_pixeldist_poly");
  const std::vector<double> values = polynomial.numbers(6);
  if (values[0] != 0.0) polynomial.fail("begins with {}; a constant term of 0 is accepted", values[0]);
  std::vector<double> parameters;
  append(parameters, std::span(values).subspan(1));
  append(parameters, intrinsics.at("linear_cde").numbers(3));
  parameters.push_back(from_distance ? 1.0 : 0.0);
  return parameters;
}

// OpenCV's order is k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4.
std::vector<double> pinhole_parameters(const DocumentNode& intrinsics) {
  const std::vector<double> radial = intrinsics.at("radial_coeffs").numbers(6);
  std::vector<double> parameters;
  append(parameters, std::span(radial).first(2));
  append(parameters, intrinsics.at("tangential_coeffs").numbers(2));
  append(parameters, std::span(radial).subspan(2));
  append(parameters, intrinsics.at("thin_prism_coeffs").numbers(4));
  return parameters;
}

Camera read_camera(const DocumentNode& camera) {
  if (const auto distortion = camera.find("external_distortion"); distortion && !distortion->is_null()) {
    distortion->fail("distortion by a windshield is not supported; null is accepted");
  }
  const DocumentNode type = camera.at("camera_model_type"), intrinsics = camera.at("intrinsics");
  const std::vector<double> centre = intrinsics.at("principal_point").numbers(2);
  Calibration calibration{.model = "ftheta", .size = image_size(camera.at("resolution")), .parameters = {}};
  calibration.centre = {centre[0], centre[1]};
  if (type.text() == "ftheta") {
    calibration.centre += centre_of_first_pixel;
    calibration.parameters = ftheta_parameters(intrinsics);
  } else if (type.text() == "opencv-fisheye") {
    calibration.model = "opencv_fisheye";
    calibration.parameters = intrinsics.at("forward_poly").numbers(4);
  } else if (type.text() == "opencv-pinhole") {
    calibration.model = "opencv";
    calibration.parameters = pinhole_parameters(intrinsics);
  } else {
    fail_unknown(type, "camera model", type.text(), {"ftheta", "opencv-fisheye", "opencv-pinhole"});
  }
  if (type.text() != "ftheta") {
    const std::vector<double> focal = intrinsics.at("focal_length").numbers(2);
    calibration.focal = {focal[0], focal[1]};
  }
  if (const auto angle = intrinsics.find("max_angle_rad")) calibration.max_angle = angle->number();
  return to_camera(intrinsics.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  std::vector<CameraFile::Entry> entries;
  const auto add = [&](const std::string& key, const DocumentNode& camera) {
    const auto name = camera.find("logical_sensor_name");
    entries.push_back({name ? name->text() : key, [camera] { return read_camera(camera); }});
  };
  const DocumentNode root(document);
  if (is_camera(root)) {
    add("camera", root);
  } else {
    for (const auto& [name, camera] : root.members()) {
      if (is_camera(camera)) add(name, camera);
    }
  }
  return entries;
}

}  // namespace

const CameraFormat nvidia_format = {
    .name = "nvidia",
    .what = "NVIDIA sensor rig (JSON)",
    .recognised = "cameras with `camera_model_type` and `intrinsics`",
    .models = "`ftheta` by either polynomial with c, d, e; `opencv-fisheye`; `opencv-pinhole`",
    .convention =
        "ftheta: first pixel's centre at (0, 0), the others: corner; reference_poly 1 distance to angle, 2 angle to "
        "distance; radians",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
