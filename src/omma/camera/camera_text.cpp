// Cameras as people write them: `equidistant:fov_deg=180,fit=full`.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/camera/camera.h"
#include "omma/camera/camera_parameters.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/camera/files/camera_file.h"
#include "omma/math/heading.h"

namespace omma {
namespace {

constexpr double radians_per_degree = 3.14159265358979323846 / 180.0;

constexpr const char* focal_names[] = {"f", "fx", "fy", "f_mm", "sensor_mm"};

// A lens's text taken apart: which of its parameters are there, and what they hold.
class LensText {
 public:
  LensText(const LensModel& model, Spec spec) : model_(model), spec_(std::move(spec)) {
    std::vector<std::string> names;
    for (const CameraParameterInfo& parameter : common_camera_parameters()) {
      for (const std::string& name : split(parameter.name, ',')) {
        names.push_back(name.substr(name.find_first_not_of(' ')));
      }
    }
    for (const LensParameterInfo& parameter : model.info.parameters) {
      names.emplace_back(parameter.name);
    }
    for (const auto& [key, value] : spec_.values) {
      if (std::ranges::find(names, key) == names.end()) {
        throw CommandError("{}", unknown_name(spec_.name + " parameter", key, names));
      }
    }
  }

  bool has(const std::string& key) const { return spec_.values.contains(key); }

  const std::string& value(const std::string& key) const { return spec_.values.at(key); }

  /// "equidistant: fov_deg", the beginning of a message.
  std::string label(std::string_view key) const { return fmt::format("{}: {}", spec_.name, key); }

  std::optional<double> number(const std::string& key) const {
    if (!has(key)) return {};
    return parse_number(label(key), value(key));
  }

  double number_within(const std::string& key, double low, double high, double otherwise) const {
    const double number = this->number(key).value_or(otherwise);
    if (!(number >= low && number <= high)) {
      throw CommandError("{}={} is out of range; {} to {} is accepted", label(key), number, low, high);
    }
    return number;
  }

  double lens_parameter(const LensParameterInfo& parameter) const {
    const std::vector<std::string> names = choices(parameter);
    if (names.empty()) return number_within(parameter.name, parameter.min, parameter.max, parameter.default_value);
    if (!has(parameter.name)) return parameter.default_value;
    const auto found = std::ranges::find(names, value(parameter.name));
    if (found == names.end()) {
      throw CommandError("{}: {}", spec_.name, unknown_name(parameter.name, value(parameter.name), names));
    }
    return static_cast<double>(found - names.begin());
  }

  std::optional<ImageSize> size() const {
    if (has("width") != has("height")) {
      throw CommandError("{} is missing: width and height go together", label(has("width") ? "height" : "width"));
    }
    if (!has("width")) return {};
    const auto side = [&](const std::string& key) {
      const long pixels = parse_integer(label(key), value(key));
      return static_cast<int>(std::clamp(pixels, -1L, max_image_side + 1L));
    };
    const ImageSize size{side("width"), side("height")};
    check_image_size(spec_.name, size);
    return size;
  }

  Fit fit() const {
    const LensInfo& info = model_.info;
    if (!has("fit")) return info.default_fit;
    const Fit fit = parse_fit(spec_.name, value("fit"));
    if (fit == Fit::diagonal && !info.radial) {
      throw CommandError(
          "{}: fit={} needs a lens that is the same in every direction from its axis, which {} is "
          "not; width, height, shorter or longer is accepted",
          spec_.name, value("fit"), info.name);
    }
    return fit;
  }

 private:
  const LensModel& model_;
  Spec spec_;
};

// How wide a field of view a lens can have along one extent of the image.
struct FovLimit {
  double deg;
  bool inclusive;
};

glm::dvec3 edge_direction(double fov_deg, bool along_height) {
  const double half = 0.5 * fov_deg * radians_per_degree;
  return along_height ? glm::dvec3(0.0, std::sin(half), std::cos(half))
                      : glm::dvec3(std::sin(half), 0.0, std::cos(half));
}

FovLimit fov_limit(const Lens& lens, bool along_height) {
  const LensInfo& info = lens.model->info;
  if (info.radial) {
    const double formula_deg = 2.0 * info.max_angle(lens.parameters) / radians_per_degree;
    if (formula_deg < info.max_fov_deg - 1e-3) return {formula_deg, true};
    return {info.max_fov_deg, info.max_fov_inclusive};
  }
  const auto shown = [&](double fov_deg) {
    glm::dvec2 plane;
    return lens.model->project(lens.parameters, edge_direction(fov_deg, along_height), plane);
  };
  // Along the height between the poles, if the lens shows them.
  const double most = along_height ? 180.0 : info.max_fov_deg;
  if ((along_height || info.max_fov_inclusive) && shown(most)) return {most, true};
  double inside = 0.0, outside = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (shown(middle) ? inside : outside) = middle;
  }
  if (inside < most - 1e-3) return {inside, true};
  return {most, false};
}

// The focal length at which `fov_deg` spans the extent of the image that `fit` names.
double focal_from_fov(const LensText& text, const Lens& lens, Fit fit, double fov_deg) {
  const bool upright = lens.size.height > lens.size.width;
  const bool along_height = fit == Fit::height || (fit == Fit::shorter && !upright) || (fit == Fit::longer && upright);
  const FovLimit limit = fov_limit(lens, along_height);
  glm::dvec2 plane;
  const bool within = fov_deg >= min_fov_deg && (fov_deg < limit.deg || (limit.inclusive && fov_deg == limit.deg));
  if (!within || !lens.model->project(lens.parameters, edge_direction(fov_deg, along_height), plane)) {
    throw CommandError("{}={} is out of range; {} to {}{} is accepted{}", text.label("fov_deg"), fov_deg, min_fov_deg,
                       limit.inclusive ? "" : "less than ", limit.deg,
                       lens.model->info.radial ? "" : fmt::format(" along the {}", along_height ? "height" : "width"));
  }
  return half_extent(fit, lens.size) / (along_height ? plane.y : plane.x);
}

// Pixels per unit of the plane, from whichever of `f`, `fx` and `fy`, `f_mm` and `sensor_mm` is there.
glm::dvec2 given_focal(const LensText& text, const Lens& lens) {
  const auto refuse_beside = [&](const char* key, std::initializer_list<const char*> others) {
    for (const char* other : others) {
      if (text.has(key) && text.has(other)) {
        throw CommandError("{} and {} say the same thing twice; give one of them", text.label(key), other);
      }
    }
  };
  for (const char* key : focal_names) refuse_beside(key, {"fov_deg", "fit"});
  refuse_beside("f_mm", {"f", "fx", "fy"});
  refuse_beside("sensor_mm", {"f", "fx", "fy"});
  if (text.has("f") && (text.has("fx") || text.has("fy"))) {
    throw CommandError("{} stands for both fx and fy; give f alone, or fx and fy", text.label("f"));
  }
  if (text.has("fx") != text.has("fy")) {
    throw CommandError("{} is missing: give fx and fy, or f for both", text.label(text.has("fx") ? "fy" : "fx"));
  }
  const auto positive = [&](const char* key) { return text.number_within(key, 1e-3, 1e9, 0.0); };
  if (text.has("fx")) return {positive("fx"), positive("fy")};
  if (text.has("f")) return glm::dvec2(positive("f"));

  const LensInfo& info = lens.model->info;
  if (info.plane_in_mm && text.has("f_mm")) {
    throw CommandError("{} has no place: the formula of {} is in millimetres; give sensor_mm alone", text.label("f_mm"),
                       info.name);
  }
  for (const char* key : {"f_mm", "sensor_mm"}) {
    if (!text.has(key) && !(info.plane_in_mm && std::string_view(key) == "f_mm")) {
      throw CommandError("{} is missing: f_mm and sensor_mm go together", text.label(key));
    }
  }
  const double focal_mm = info.plane_in_mm ? 1.0 : positive("f_mm");
  return glm::dvec2(focal_mm * lens.size.width / positive("sensor_mm"));
}

// Lays a part of the plane over the whole image.
void fill_image(const LensText& text, const PlaneRectangle& frame, Lens& lens) {
  for (const char* key : {"fov_deg", "fit"}) {
    if (text.has(key)) {
      throw CommandError("{} has no place: what {} shows fills the image, whatever its shape; leave it away",
                         text.label(key), lens.model->info.name);
    }
  }
  lens.focal = glm::dvec2(lens.size.width, lens.size.height) / (frame.max - frame.min);
  lens.centre = -frame.min * lens.focal;
}

// Sets focal lengths from whatever gives them, `fov_deg` included, and how far the lens sees.
void set_focal_and_angle(const LensText& text, Lens& lens) {
  const LensInfo& info = lens.model->info;
  const double limit = lens.parameters.max_angle;
  if (!(limit > 0.0)) {
    throw CommandError("{}: with these parameters the image's radius does not grow with the angle from the axis ({})",
                       info.name, info.formula);
  }

  if (std::ranges::any_of(focal_names, [&](const char* key) { return text.has(key); })) {
    lens.focal = given_focal(text, lens);
  } else if (const auto frame = info.frame ? info.frame(lens.parameters) : std::nullopt) {
    fill_image(text, *frame, lens);
  } else {
    if (!text.has("fov_deg") && info.default_fov_deg == 0) {
      throw CommandError("{} is missing, and so are f, fx and fy: a calibrated lens has no default; for example {}",
                         text.label("fov_deg"), info.example);
    }
    const Fit fit = text.fit();
    const double fov_deg = text.number("fov_deg").value_or(info.default_fov_deg);
    lens.focal = glm::dvec2(focal_from_fov(text, lens, fit, fov_deg));
    if (fit == Fit::shorter && info.radial) {
      lens.parameters.max_angle = std::min(limit, 0.5 * fov_deg * radians_per_degree);
    }
  }

  if (text.has("max_angle_deg")) {
    const double limit_deg = limit / radians_per_degree;
    const double angle_deg = text.number_within("max_angle_deg", 0.5 * min_fov_deg, limit_deg * (1 + 1e-12), limit_deg);
    lens.parameters.max_angle = std::min(limit, angle_deg * radians_per_degree);
  }
}

// The same lens for an image of another size but the same shape, up to rounding to whole pixels.
void rescale(std::string_view what, Lens& lens, const ImageSize& size) {
  const glm::dvec2 scale = image_scale(what, lens.size, size);
  lens.focal *= scale;
  lens.centre *= scale;
  lens.size = size;
}

// Adds what a preset says where the text says nothing.
void apply_preset(const LensPreset& preset, Spec& spec) {
  const auto given = [&](const char* key) { return spec.values.contains(key); };
  for (const auto& [key, value] : parse_spec(fmt::format("{}:{}", preset.name, preset.settings)).values) {
    if (key == "fov_deg" && std::ranges::any_of(focal_names, given)) continue;
    spec.values.emplace(key, value);
  }
}

Camera make_lens_camera(const LensModel& model, Spec spec, std::optional<ImageSize> size) {
  const std::string name = spec.name;
  if (const LensPreset* preset = find_lens_preset(name)) apply_preset(*preset, spec);
  const LensText text(model, std::move(spec));
  const std::optional<ImageSize> own_size = text.size();

  Lens lens;
  lens.model = &model;
  lens.size = own_size ? *own_size : size.value_or(default_image_size);
  std::vector<double> values;
  for (const LensParameterInfo& parameter : model.info.parameters) values.push_back(text.lens_parameter(parameter));
  lens.parameters = lens_parameters(model.info, values);
  if (const char* contradiction = model.info.contradiction ? model.info.contradiction(lens.parameters) : nullptr) {
    throw CommandError("{}: {}", name, contradiction);
  }
  lens.centre = {0.5 * lens.size.width, 0.5 * lens.size.height};
  set_focal_and_angle(text, lens);
  lens.centre = {text.number("cx").value_or(lens.centre.x), text.number("cy").value_or(lens.centre.y)};
  if (size && *size != lens.size) rescale(text.label("width"), lens, *size);
  lens.cameraFromLens =
      lens_rotation([&](const char* key, double limit) { return text.number_within(key, -limit, limit, 0.0); });

  Camera camera(std::move(lens));
  if (camera.pixels_per_radian() == 0.0) {
    throw CommandError("{}: the camera sees nothing: cx and cy put all it could see outside the image", name);
  }
  return camera;
}

}  // namespace

std::string image_size_refusal(ImageSize size) {
  const auto within = [](int side) { return side >= 1 && side <= max_image_side; };
  if (within(size.width) && within(size.height) && int64_t{size.width} * size.height <= max_image_pixels) return {};
  return fmt::format("an image of {} x {} pixels; 1 to {} a side is accepted, up to {} in all", size.width, size.height,
                     max_image_side, max_image_pixels);
}

void check_image_size(std::string_view what, ImageSize size) {
  if (const std::string why = image_size_refusal(size); !why.empty()) throw CommandError("{}: {}", what, why);
}

Camera make_camera(std::string_view text, std::optional<ImageSize> size, const Limits& limits) {
  if (size) check_image_size("size", *size);
  if (const DeformationInfo* deformation = find_deformation(text.substr(0, text.find(':')))) {
    return deformation->make(parse_spec(text), size, limits);
  }
  if (text.ends_with(".npy")) {
    RayMap map = load_ray_map(text, limits);
    if (size && *size != map.size) {
      throw CommandError("{}: the ray map has {} x {} pixels and {} x {} was asked for; leave the size away", text,
                         map.size.width, map.size.height, size->width, size->height);
    }
    return Camera(std::move(map));
  }
  if (const auto file = camera_file_text(text)) {
    const Camera camera = load_camera(*file, limits);
    if (!size || *size == camera.size()) return camera;
    if (!camera.lens()) {
      throw CommandError(
          "{}: the pieces are of an image of {} x {} pixels and {} x {} was asked for; leave the size away", text,
          camera.size().width, camera.size().height, size->width, size->height);
    }
    Lens lens = *camera.lens();
    rescale(text, lens, *size);
    return Camera(std::move(lens));
  }
  Spec spec = parse_spec(text);
  const LensModel* model = find_lens_model(spec.name);
  if (!model) {
    std::vector<std::string> names;
    for (const LensModel& known : lens_models()) names.emplace_back(known.info.name);
    for (const DeformationInfo& known : deformations()) names.emplace_back(known.name);
    throw CommandError(
        "{}; or the name of a ray map, a .npy file, of a calibration file, FILE or FILE#CAMERA, or of pieces, .json",
        unknown_name("camera", spec.name, names));
  }
  return make_lens_camera(*model, std::move(spec), size);
}

std::string to_text(const Camera& camera) {
  const Lens* lens = camera.lens();
  if (!lens) {
    const std::string& source = camera.pieces() ? camera.pieces()->source() : camera.ray_map()->source;
    if (source.empty())
      throw CommandError("a {} camera that comes from no file cannot be written as text", camera.kind());
    return source;
  }
  const LensInfo& info = lens->model->info;
  std::string text = fmt::format("{}:", info.name);
  text += lens->focal.x == lens->focal.y ? fmt::format("f={}", lens->focal.x)
                                         : fmt::format("fx={},fy={}", lens->focal.x, lens->focal.y);
  text += fmt::format(",cx={},cy={},width={},height={}", lens->centre.x, lens->centre.y, lens->size.width,
                      lens->size.height);
  if (lens->parameters.max_angle != info.max_angle(lens->parameters)) {
    text += fmt::format(",max_angle_deg={}", lens->parameters.max_angle / radians_per_degree);
  }
  const Heading heading = heading_of(lens->cameraFromLens);
  for (const auto& [key, angle] :
       {std::pair("yaw_deg", heading.yaw), {"pitch_deg", heading.pitch}, {"roll_deg", heading.roll}}) {
    // As they were typed, not as the rotation's rounding left them.
    const double degrees = std::round(angle / radians_per_degree * 1e12) / 1e12;
    if (degrees != 0.0) text += fmt::format(",{}={}", key, degrees);
  }
  for (size_t i = 0; i < info.parameters.size(); ++i) {
    const LensParameterInfo& parameter = info.parameters[i];
    const double value = lens->parameters.k[i];
    if (value == parameter.default_value) continue;
    const std::vector<std::string> names = choices(parameter);
    text += names.empty() ? fmt::format(",{}={}", parameter.name, value)
                          : fmt::format(",{}={}", parameter.name, names.at(static_cast<size_t>(value)));
  }
  return text;
}

}  // namespace omma
