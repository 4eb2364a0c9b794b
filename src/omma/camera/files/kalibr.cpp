// Kalibr's camchain: cam0, cam1, …, each with camera_model, intrinsics, distortion_model, distortion_coeffs and
// resolution. Extrinsics, topics and line delays are not read.
//
// The centre of the first pixel is (0, 0); x right, y down, z forward. Intrinsics begin with the model's own numbers:
// pinhole fu fv pu pv; omni xi fu fv pu pv; eucm alpha beta fu fv pu pv; ds xi alpha fu fv pu pv. Distortion: radtan
// k1 k2 p1 p2; equidistant k1 k2 k3 k4 (of θ³, θ⁵, θ⁷, θ⁹); fov w, radians.
#include <algorithm>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

// A camera model with a distortion, and which lens that makes.
struct Model {
  const char* camera;
  const char* distortion;
  const char* lens;
  size_t own;     ///< numbers before fu in the intrinsics
  size_t coeffs;  ///< numbers of the distortion
};

constexpr Model models[] = {
    {"pinhole", "none", "perspective", 0, 0},
    {"pinhole", "radtan", "opencv", 0, 4},
    {"pinhole", "equidistant", "opencv_fisheye", 0, 4},
    {"pinhole", "fov", "fov", 0, 1},
    {"omni", "none", "mei", 1, 0},
    {"omni", "radtan", "mei", 1, 4},
    {"eucm", "none", "eucm", 2, 0},
    {"ds", "none", "double_sphere", 2, 0},
};

bool is_camera_name(std::string_view name) {
  return name.starts_with("cam") && name.size() > 3 &&
         std::all_of(name.begin() + 3, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool recognises(const Document& document) {
  if (document.syntax != Syntax::yaml && document.syntax != Syntax::json) return false;
  return std::any_of(document.root.members.begin(), document.root.members.end(),
                     [](const auto& member) { return is_camera_name(member.name); });
}

void add_new(std::vector<std::string>& names, const char* name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
}

const Model& model_of(const DocumentNode& camera) {
  const DocumentNode camera_model = camera.at("camera_model"), distortion_model = camera.at("distortion_model");
  const std::string camera_name = camera_model.text(), distortion_name = distortion_model.text();
  std::vector<std::string> cameras, distortions;
  for (const Model& model : models) {
    add_new(cameras, model.camera);
    if (camera_name != model.camera) continue;
    if (distortion_name == model.distortion) return model;
    add_new(distortions, model.distortion);
  }
  if (distortions.empty()) fail_unknown(camera_model, "camera model", camera_name, cameras);
  fail_unknown(distortion_model, "distortion of " + camera_name, distortion_name, distortions);
}

Camera read_camera(const DocumentNode& camera) {
  const Model& model = model_of(camera);
  const DocumentNode node = camera.at("intrinsics");
  const std::vector<double> intrinsics = node.numbers(model.own + 4);
  const auto f = intrinsics.begin() + static_cast<std::ptrdiff_t>(model.own);
  Calibration calibration{.model = model.lens, .size = image_size(camera.at("resolution")), .parameters = {}};
  calibration.focal = {f[0], f[1]};
  calibration.centre = glm::dvec2(f[2], f[3]) + centre_of_first_pixel;
  calibration.parameters.assign(intrinsics.begin(), f);
  const auto coefficients = camera.find("distortion_coeffs");
  if (!coefficients && model.coeffs > 0) camera.fail("'distortion_coeffs' is missing");
  if (coefficients) {
    const std::vector<double> values = coefficients->numbers(model.coeffs);
    calibration.parameters.insert(calibration.parameters.end(), values.begin(), values.end());
  }
  return to_camera(node.place(), calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  std::vector<CameraFile::Entry> entries;
  for (const auto& [name, camera] : DocumentNode(document).members()) {
    if (is_camera_name(name)) entries.push_back({name, [camera = camera] { return read_camera(camera); }});
  }
  return entries;
}

std::string write(std::span<const NamedCamera> cameras) {
  std::string text;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const Lens& lens = lens_to_write(cameras[i], kalibr_format.name);
    const Model* found = nullptr;
    std::vector<double> parameters;
    for (const Model& model : models) {
      const auto values = parameters_as(lens, model.lens, model.own + model.coeffs);
      if (found || !values) continue;
      found = &model;
      parameters = *values;
    }
    if (!found) {
      refuse_lens(cameras[i], kalibr_format.name,
                  "perspective, opencv with k1, k2, p1 and p2, opencv_fisheye, fov, mei, eucm and double_sphere");
    }
    const auto coefficients = parameters.begin() + static_cast<std::ptrdiff_t>(found->own);
    std::vector<double> intrinsics(parameters.begin(), coefficients);
    const glm::dvec2 centre = lens.centre - centre_of_first_pixel;
    intrinsics.insert(intrinsics.end(), {lens.focal.x, lens.focal.y, centre.x, centre.y});
    text += fmt::format(
        "cam{}:\n  camera_model: {}\n  intrinsics: [{}]\n  distortion_model: {}\n  distortion_coeffs: [{}]\n"
        "  resolution: [{}, {}]\n",
        i, found->camera, comma_separated(intrinsics), found->distortion,
        comma_separated(std::vector<double>(coefficients, parameters.end())), lens.size.width, lens.size.height);
  }
  return text;
}

}  // namespace

const CameraFormat kalibr_format = {
    .name = "kalibr",
    .what = "Kalibr camchain (YAML)",
    .recognised = "`cam0`, `cam1`, … at the top",
    .models = "pinhole with none, radtan, equidistant or fov; omni with none or radtan; eucm; ds",
    .convention = "first pixel's centre at (0, 0); the model's own numbers come before fu fv pu pv; radtan k1 k2 p1 p2",
    .recognises = recognises,
    .read = read,
    .extension = ".yaml",
    .write = write,
};

}  // namespace omma
