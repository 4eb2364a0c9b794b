// Cameras of SDFormat (Gazebo): every <camera> of a world or model, named by itself or by its sensor.
//
// Angles are in radians. The image's half width is the unit of the lens's radius; scale_to_hfov makes horizontal_fov
// span the width instead. cutoff_angle counts from the axis. <intrinsics> are in pixels from the top left corner.
// <distortion> is that of Brown and Conrady, forward on the plane z = 1 as OpenCV's and in gz-rendering's distortion
// pass; classic Gazebo's legacy mode has the image's width for the focal length and is refused. Both enlarge the
// picture of a barrel so that no black border shows, which is no part of the calibration. <center>, in units of the
// image's width and height, is the principal point.
#include <algorithm>
#include <cmath>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

constexpr double half_pi = 3.14159265358979323846 / 2.0;

struct Type {
  const char* name;
  const char* lens;
};

constexpr Type types[] = {
    {"gnomonical", "perspective"},    {"stereographic", "stereographic"},       {"equidistant", "equidistant"},
    {"equisolid_angle", "equisolid"}, {"orthographic", "orthographic_fisheye"}, {"custom", "custom_radial"},
};

bool recognises(const Document& document) {
  if (document.syntax != Syntax::xml) return false;
  const DocumentNode root = root_of(document);
  return root.has("sdf") || root.has("sensor") || root.has("camera");
}

double number_or(const DocumentNode& node, const char* key, double otherwise) {
  const auto found = node.find(key);
  return found ? found->number() : otherwise;
}

std::vector<double> custom_parameters(const DocumentNode& lens) {
  const DocumentNode function = lens.at("custom_function"), fun = function.at("fun");
  const std::vector<std::string> names = {"tan", "sin", "id"};
  const auto found = std::find(names.begin(), names.end(), fun.text());
  if (found == names.end()) fail_unknown(fun, "function", fun.text(), names);
  return {number_or(function, "c1", 1.0), number_or(function, "c2", 1.0), number_or(function, "c3", 0.0),
          static_cast<double>(found - names.begin())};
}

// Turns a perspective calibration into a distorted one.
void distort(const DocumentNode& distortion, bool has_intrinsics, Calibration& calibration) {
  const std::vector<double> coefficients = members_or_zero(distortion, {"k1", "k2", "p1", "p2", "k3"});
  if (std::ranges::all_of(coefficients, [](double k) { return k == 0.0; })) return;
  for (const char* key : {"ignition:legacy_mode", "gz:legacy_mode"}) {
    const auto legacy = distortion.find(key);
    if (legacy && legacy->boolean()) {
      legacy->fail("the distortion of classic Gazebo's legacy mode is not supported; false is accepted");
    }
  }
  if (std::string_view(calibration.model) != "perspective") {
    distortion.fail("stands beside a <lens> that is not gnomonical; a pinhole camera's distortion is accepted");
  }
  if (const auto given = distortion.find("center")) {
    const std::vector<double> of_image = given->numbers(2);
    const glm::dvec2 centre(of_image[0] * calibration.size.width, of_image[1] * calibration.size.height);
    // Half a pixel both ways is the difference between counting from the first pixel's corner and from its centre.
    constexpr double same_point = 0.75;
    if (has_intrinsics && glm::distance(centre, calibration.centre) > same_point) {
      given->fail("is {}, {} in pixels, and <intrinsics> have {}, {}; the two have to be one point", centre.x, centre.y,
                  calibration.centre.x, calibration.centre.y);
    }
    if (!has_intrinsics) calibration.centre = centre;
  }
  calibration.model = "opencv";
  calibration.parameters = coefficients;
}

// The radius on the model's plane at half the horizontal field of view.
double radius_at(const DocumentNode& fov, const Calibration& calibration) {
  const LensModel& model = *find_lens_model(calibration.model);
  const double half = 0.5 * fov.number();
  glm::dvec2 plane;
  if (!(half > 0.0) || half > 2.0 * half_pi ||
      !model.project(lens_parameters(model.info, calibration.parameters), {std::sin(half), 0.0, std::cos(half)},
                     plane) ||
      !(plane.x > 0.0)) {
    fov.fail("{} radians is out of range for {}", fov.number(), model.info.name);
  }
  return plane.x;
}

Camera read_camera(const DocumentNode& camera) {
  const DocumentNode image = camera.at("image");
  Calibration calibration{
      .model = "perspective", .size = image_size(image.at("width"), image.at("height")), .parameters = {}};
  calibration.centre = {0.5 * calibration.size.width, 0.5 * calibration.size.height};
  const auto lens = camera.find("lens");
  if (const auto intrinsics = lens ? lens->find("intrinsics") : std::nullopt) {
    if (const double skew = number_or(*intrinsics, "s", 0.0); skew != 0.0) {
      intrinsics->at("s").fail("is {}; a skew of 0 is accepted", skew);
    }
    calibration.focal = {intrinsics->at("fx").number(), intrinsics->at("fy").number()};
    calibration.centre = {intrinsics->at("cx").number(), intrinsics->at("cy").number()};
    if (const auto distortion = camera.find("distortion")) distort(*distortion, true, calibration);
    return to_camera(intrinsics->place(), calibration);
  }
  bool scale_to_fov = true;
  double focal = 1.0;
  if (const auto type = lens ? lens->find("type") : std::nullopt) {
    std::vector<std::string> known;
    const Type* found = nullptr;
    for (const Type& candidate : types) {
      known.emplace_back(candidate.name);
      if (type->text() == candidate.name) found = &candidate;
    }
    if (!found) fail_unknown(*type, "lens type", type->text(), known);
    calibration.model = found->lens;
    if (type->text() == "custom") {
      calibration.parameters = custom_parameters(*lens);
      focal = number_or(lens->at("custom_function"), "f", 1.0);
    }
    const auto scale = lens->find("scale_to_hfov");
    scale_to_fov = !scale || scale->boolean();
    calibration.max_angle = number_or(*lens, "cutoff_angle", half_pi);
  }
  const double half_width = 0.5 * calibration.size.width;
  calibration.focal =
      glm::dvec2(scale_to_fov ? half_width / radius_at(camera.at("horizontal_fov"), calibration) : half_width * focal);
  if (const auto distortion = camera.find("distortion")) distort(*distortion, false, calibration);
  return to_camera(camera.place(), calibration);
}

void add_cameras(const DocumentNode& node, const std::string& name, std::vector<CameraFile::Entry>& entries) {
  if (!node.is_map()) return;
  for (const auto& [key, child] : node.members()) {
    const auto given = child.find("@name");
    const std::string child_name = given ? given->text() : name;
    if (key == "camera") {
      entries.push_back({child_name.empty() ? "camera" : child_name, [child = child] { return read_camera(child); }});
    } else {
      add_cameras(child, child_name, entries);
    }
  }
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  std::vector<CameraFile::Entry> entries;
  add_cameras(DocumentNode(document), "", entries);
  return entries;
}

}  // namespace

const CameraFormat sdf_format = {
    .name = "sdf",
    .what = "SDFormat, Gazebo (XML)",
    .recognised = "`<sdf>`, `<sensor>` or `<camera>` at the top",
    .models =
        "pinhole with `<distortion>` (k1, k2, k3, p1, p2) or without; `<lens>`: gnomonical, stereographic, "
        "equidistant, equisolid_angle, orthographic, custom",
    .convention =
        "radians; radius in half widths, or horizontal_fov across the width; cutoff_angle from the axis; "
        "distortion as OpenCV's, its center in units of the image's size",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
