// nerfstudio's transforms.json: camera_model with COLMAP's names, fl_x fl_y cx cy w h and coefficients by name, for all
// frames or for each. Poses are not read.
//
// The top left corner is (0, 0), as in Omma. OPENCV takes k1 k2 p1 p2 k3; its k4 is nerfstudio's own (of r⁸, where
// OpenCV's k4 divides) and is refused. camera_angle_x is the field of view across the width in radians.
#include <cmath>
#include <nlohmann/json.hpp>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

using Json = nlohmann::ordered_json;

struct Model {
  const char* name;
  const char* lens;
  std::vector<const char*> parameters;  ///< in the order of the lens
};

const std::vector<Model>& models() {
  static const std::vector<Model> list = {
      {"PINHOLE", "perspective", {}},
      {"SIMPLE_PINHOLE", "perspective", {}},
      {"OPENCV", "opencv", {"k1", "k2", "p1", "p2", "k3"}},
      {"SIMPLE_RADIAL", "opencv", {"k1"}},
      {"RADIAL", "opencv", {"k1", "k2"}},
      {"OPENCV_FISHEYE", "opencv_fisheye", {"k1", "k2", "k3", "k4"}},
      {"SIMPLE_RADIAL_FISHEYE", "opencv_fisheye", {"k1"}},
      {"RADIAL_FISHEYE", "opencv_fisheye", {"k1", "k2"}},
      {"FISHEYE624", "fisheye624", {}},
  };
  return list;
}

constexpr std::string_view panorama = "EQUIRECTANGULAR";

bool recognises(const Document& document) {
  if (document.syntax != Syntax::json) return false;
  const DocumentNode root = root_of(document);
  return root.has("fl_x") || root.has("camera_angle_x") || (root.has("frames") && root.has("camera_model")) ||
         (root.has("frames") && root.at("frames").is_list());
}

// What a frame says, else what is said for all of them.
class Frame {
 public:
  Frame(DocumentNode all, std::optional<DocumentNode> frame) : all_(std::move(all)), frame_(std::move(frame)) {}
  std::optional<DocumentNode> find(const char* key) const {
    const std::optional<DocumentNode> own = frame_ ? frame_->find(key) : std::nullopt;
    return own ? own : all_.find(key);
  }
  DocumentNode at(const char* key) const {
    if (const auto found = find(key)) return *found;
    return node().at(key);
  }
  double number_or(const char* key, double otherwise) const {
    const auto found = find(key);
    return found ? found->number() : otherwise;
  }
  const DocumentNode& node() const { return frame_ ? *frame_ : all_; }

 private:
  DocumentNode all_;
  std::optional<DocumentNode> frame_;
};

glm::dvec2 focal_of(const Frame& frame, ImageSize size) {
  if (frame.find("fl_x")) {
    const double fx = frame.at("fl_x").number();
    return {fx, frame.number_or("fl_y", fx)};
  }
  const DocumentNode angle = frame.at("camera_angle_x");
  const double radians = angle.number();
  if (!(radians > 0.0 && radians < 3.14159265358979323846)) angle.fail("{} is no angle between 0 and π", radians);
  return glm::dvec2(0.5 * size.width / std::tan(0.5 * radians));
}

Camera read_camera(const Frame& frame) {
  const ImageSize size = image_size(frame.at("w"), frame.at("h"));
  const auto name_node = frame.find("camera_model");
  const std::string name = name_node ? name_node->text() : "OPENCV";
  const Place place = frame.node().place();
  if (name == panorama) return to_equirectangular(place, size);
  const Model* model = nullptr;
  std::vector<std::string> known = {std::string(panorama)};
  for (const Model& candidate : models()) {
    known.emplace_back(candidate.name);
    if (name == candidate.name) model = &candidate;
  }
  if (!model) fail_unknown(*name_node, "camera model", name, known);
  Calibration calibration{.model = model->lens, .size = size, .focal = focal_of(frame, size), .parameters = {}};
  calibration.centre = {frame.number_or("cx", 0.5 * size.width), frame.number_or("cy", 0.5 * size.height)};
  if (name == "FISHEYE624") {
    calibration.parameters = frame.at("distortion_params").numbers(12);
  } else if (const auto list = frame.find("distortion_params")) {
    list->fail("is for FISHEYE624; {} takes its coefficients by name", name);
  }
  for (const char* key : {"k1", "k2", "k3", "k4", "p1", "p2"}) {
    const bool taken =
        std::find(model->parameters.begin(), model->parameters.end(), std::string_view(key)) != model->parameters.end();
    const auto value = frame.find(key);
    if (value && !taken && value->number() != 0.0) value->fail("is {}, and {} has no {}", value->number(), name, key);
  }
  for (const char* key : model->parameters) calibration.parameters.push_back(frame.number_or(key, 0.0));
  return to_camera(place, calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  const DocumentNode root(document);
  std::vector<CameraFile::Entry> entries;
  if (const auto frames = root.find("frames")) {
    for (const DocumentNode& frame : frames->items()) {
      if (!frame.has("fl_x") && !frame.has("camera_angle_x") && !frame.has("camera_model")) continue;
      const Frame lens(root, frame);
      entries.push_back({frame.at("file_path").text(), [lens] { return read_camera(lens); }});
    }
  }
  if (entries.empty()) {
    const Frame all(root, std::nullopt);
    entries.push_back({"camera", [all] { return read_camera(all); }});
  }
  return entries;
}

std::string write(std::span<const NamedCamera> cameras) {
  const NamedCamera& camera = only_one(cameras, nerfstudio_format.name);
  const Lens& lens = lens_to_write(camera, nerfstudio_format.name);
  Json json;
  if (is_whole_panorama(lens)) {
    json["camera_model"] = panorama;
  } else if (const auto fisheye624 = parameters_as(lens, "fisheye624", 12)) {
    json["camera_model"] = "FISHEYE624";
    json["distortion_params"] = *fisheye624;
  } else {
    const Model* found = nullptr;
    for (const Model& model : models()) {
      const auto values = parameters_as(lens, model.lens, model.parameters.size());
      if (found || !values || model.lens == std::string_view("fisheye624")) continue;
      found = &model;
      json["camera_model"] = model.name;
      for (size_t i = 0; i < values->size(); ++i) json[model.parameters[i]] = (*values)[i];
    }
    if (!found) {
      refuse_lens(camera, nerfstudio_format.name,
                  "perspective, opencv with k1, k2, p1, p2 and k3, opencv_fisheye, fisheye624 and equirectangular");
    }
  }
  json["fl_x"] = lens.focal.x;
  json["fl_y"] = lens.focal.y;
  json["cx"] = lens.centre.x;
  json["cy"] = lens.centre.y;
  json["w"] = lens.size.width;
  json["h"] = lens.size.height;
  json["frames"] = Json::array();
  return json.dump(2) + "\n";
}

}  // namespace

const CameraFormat nerfstudio_format = {
    .name = "nerfstudio",
    .what = "nerfstudio transforms.json",
    .recognised = "`fl_x`, `camera_angle_x` or `frames`",
    .models = "`PINHOLE`, `OPENCV`, `OPENCV_FISHEYE`, `FISHEYE624`, `EQUIRECTANGULAR`, COLMAP's simple and radial ones",
    .convention =
        "image's corner at (0, 0), as Omma's; named coefficients; k4 of OPENCV is not OpenCV's and is refused",
    .recognises = recognises,
    .read = read,
    .extension = ".json",
    .write = write,
};

}  // namespace omma
