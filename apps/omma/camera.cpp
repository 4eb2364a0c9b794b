// omma camera: what a camera is, where points land in its image, which way its pixels look; the camera as another
// model or in another program's file.
#include "omma/camera/camera.h"

#include <fmt/core.h>

#include <array>
#include <nlohmann/json.hpp>

#include "arguments.h"
#include "commands.h"
#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/camera/field_of_view.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/fit.h"
#include "omma/camera/pieces/approximate.h"
#include "omma/image/npy.h"
#include "reading.h"

namespace omma::tool {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees_per_radian = 180.0 / 3.14159265358979323846;

/// As typed.
struct Options {
  std::string camera;
  Text size, rays, model, output, format, pieces, tolerance, count;
  std::vector<std::string> project, unproject;
  ReadingOptions reading;
  bool json = false;
};

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json describe(const Camera& camera) {
  const ImageSize size = camera.size();
  const FieldOfView fov = field_of_view(camera);
  Json json{{"camera", to_text(camera)}, {"width", size.width}, {"height", size.height}, {"model", camera.kind()}};
  if (const Lens* lens = camera.lens()) {
    json["formula"] = lens->model->info.formula;
    json["focal_px"] = {lens->focal.x, lens->focal.y};
    json["centre_px"] = {lens->centre.x, lens->centre.y};
    json["max_angle_deg"] = lens->parameters.max_angle * degrees_per_radian;
  }
  if (const PieceSet* pieces = camera.pieces()) json["piece_count"] = pieces->pieces().size();
  json["horizontal_fov_deg"] = optional_number(fov.horizontal_deg);
  json["vertical_fov_deg"] = optional_number(fov.vertical_deg);
  json["diagonal_fov_deg"] = optional_number(fov.diagonal_deg);
  json["pixels_per_degree"] = camera.pixels_per_radian() / degrees_per_radian;
  return json;
}

Json projections(const Camera& camera, const Options& options) {
  Json list = Json::array();
  for (const std::string& text : options.project) {
    const glm::dvec3 direction = vector3_of("--project", text);
    if (glm::length(direction) == 0.0) throw CommandError("--project {}: is no direction", text);
    const std::optional<glm::dvec2> pixel = camera.project(direction);
    list.push_back({{"direction", {direction.x, direction.y, direction.z}},
                    {"pixel", pixel ? Json({pixel->x, pixel->y}) : Json(nullptr)}});
  }
  return list;
}

Json unprojections(const Camera& camera, const Options& options) {
  Json list = Json::array();
  for (const std::string& text : options.unproject) {
    const glm::dvec2 pixel = vector2_of("--unproject", text);
    const std::optional<Ray> ray = camera.unproject(pixel);
    list.push_back({{"pixel", {pixel.x, pixel.y}},
                    {"direction", ray ? Json({ray->direction.x, ray->direction.y, ray->direction.z}) : Json(nullptr)}});
  }
  return list;
}

/// The camera as the model of `--model NAME[:PARAMETER,…]`, and how far its pixels are from what they were.
CameraFit convert(const Camera& camera, const std::string& text) {
  const size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const LensModel* model = find_lens_model(name);
  if (!model) {
    std::vector<std::string> names;
    for (const LensModel& known : lens_models()) names.emplace_back(known.info.name);
    throw CommandError("--model: {}", unknown_name("camera model", name, names));
  }
  if (colon == std::string::npos) return fit_camera(camera, *model);
  return fit_camera(camera, *model, split(text.substr(colon + 1), ','));
}

Json describe(const CameraFit& fit) {
  const Residual& residual = fit.residual;
  return {{"part_of_image", fit.part},   {"within_deg", fit.angle * degrees_per_radian},
          {"points", residual.points},   {"not_seen", residual.lost},
          {"mean_px", residual.mean_px}, {"p95_px", residual.p95_px},
          {"max_px", residual.max_px},   {"max_at", {residual.max_at.x, residual.max_at.y}}};
}

PieceOptions piece_options(const Options& options) {
  PieceOptions pieces;
  if (options.tolerance) pieces.tolerance_px = parse_number("--tolerance", *options.tolerance);
  if (options.count) {
    const long count = parse_integer("--count", *options.count);
    if (count < 1 || count > 1'000'000) throw CommandError("--count {}: 1 to 1000000 is accepted", count);
    pieces.count = static_cast<int>(count);
  }
  return pieces;
}

/// Writes the pieces that stand for the camera, and says how many they are and how far they are off.
Json write_pieces(const Camera& camera, const Options& options) {
  Approximation made = approximate(camera, piece_options(options));
  const size_t count = made.pieces.pieces().size();
  const NamedCamera named{"pieces", Camera(std::move(made.pieces))};
  write_camera_file(*options.pieces, {&named, 1}, "pieces");
  return {{"count", count},
          {"layout", made.layout},
          {"points", made.error.points},
          {"mean_px", made.error.mean_px},
          {"p95_px", made.error.p95_px},
          {"max_px", made.error.max_px},
          {"max_at", {made.error.worst.x, made.error.worst.y}}};
}

std::string value_text(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& element : value) text += fmt::format("{}{}", text.empty() ? "" : ",", value_text(element));
  return text;
}

void print_text(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) {
      for (const auto& [name, number] : value.items()) fmt::print("{:<24}{}\n", key + ' ' + name, value_text(number));
      continue;
    }
    if (key != "project" && key != "unproject") {
      fmt::print("{:<20}{}\n", key, value_text(value));
      continue;
    }
    for (const Json& point : value) {
      const bool project = key == "project";
      const Json& from = point[project ? "direction" : "pixel"];
      fmt::print("{:<20}{} -> {}\n", key, value_text(from), value_text(point[project ? "pixel" : "direction"]));
    }
  }
}

/// The directions of all pixels' centres as a ray map, zero where there is no ray.
void write_rays(const std::string& path, const Camera& camera) {
  const ImageSize size = camera.size();
  const std::array<size_t, 3> shape{size_t(size.height), size_t(size.width), 3};
  std::vector<float> directions(shape[0] * shape[1] * shape[2], 0.0f);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const std::optional<Ray> ray = camera.unproject({x + 0.5, y + 0.5});
      if (!ray) continue;
      float* direction = &directions[3 * (size_t(y) * size_t(size.width) + size_t(x))];
      for (int c = 0; c < 3; ++c) direction[c] = static_cast<float>(ray->direction[c]);
    }
  }
  write_npy<float>(path, shape, directions);
}

void run(const Options& options) {
  if (options.rays) {
    if (!options.rays->ends_with(".npy")) throw CommandError("--rays {}: a name that ends in .npy", *options.rays);
    require_writable(*options.rays);
  }
  if (options.pieces) {
    if (!options.pieces->ends_with(".json"))
      throw CommandError("--pieces {}: a name that ends in .json", *options.pieces);
    require_writable(*options.pieces);
  } else if (options.tolerance || options.count) {
    throw CommandError("{} is for --pieces, which is missing", options.tolerance ? "--tolerance" : "--count");
  }
  if (options.tolerance && options.count) {
    throw CommandError("--tolerance and --count both say how many pieces there are; give one of them");
  }
  if (options.format && !options.output) throw CommandError("--format is for -o, which is missing");
  if (options.output) {
    require_camera_format(*options.output, options.format.value_or(""));
    require_writable(*options.output);
  }
  std::optional<ImageSize> size;
  if (options.size) size = size_of("--size", *options.size);
  Camera camera = make_camera(options.camera, size, read_options_of(options.reading).limits);
  std::optional<CameraFit> fit;
  if (options.model) {
    fit = convert(camera, *options.model);
    camera = fit->camera;
  }
  Json json = describe(camera);
  if (fit) json["residual"] = describe(*fit);
  if (!options.project.empty()) json["project"] = projections(camera, options);
  if (!options.unproject.empty()) json["unproject"] = unprojections(camera, options);
  if (options.rays) write_rays(*options.rays, camera);
  if (options.pieces) json["pieces"] = write_pieces(camera, options);
  if (options.output) {
    const auto file = camera_file_text(options.camera);
    const NamedCamera named{file && file->name ? *file->name : "camera", camera};
    write_camera_file(*options.output, {&named, 1}, options.format.value_or(""));
  }
  if (options.json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(json);
  }
}

}  // namespace

void add_camera(const Command& tool) {
  const Command command = tool.add_command("camera", "Describe a camera; project and unproject points");
  auto options = std::make_shared<Options>();
  command
      .add_option("camera", options->camera,
                  "A lens with its parameters (see 'omma cameras'), a .npy ray map, a calibration file, FILE or "
                  "FILE#CAMERA, or a .json file of pieces")
      .type_name("CAMERA")
      .required();
  command.add_option("--size", options->size, "Pixels, default 1600x1200 or the camera's own").type_name("WxH");
  command
      .add_option("--project", options->project,
                  "Where this direction lands in the image (camera frame: +X right, +Y up, looks along -Z)")
      .type_name("X,Y,Z")
      .one_word();
  command
      .add_option("--unproject", options->unproject,
                  "Which way this point of the image looks (pixels from the top left corner, y down; the first "
                  "pixel's centre is 0.5,0.5)")
      .type_name("U,V")
      .one_word();
  command.add_option("--rays", options->rays, "Write the direction of every pixel, H x W x 3 float32: a ray map")
      .type_name("FILE.npy");
  command
      .add_option("--pieces", options->pieces,
                  "Write the perspective pieces that stand for the camera, which are a camera themselves, and say how "
                  "far they are off")
      .type_name("FILE.json");
  command
      .add_option("--tolerance", options->tolerance,
                  "As few pieces as show everything this close to where the camera does, pixels, 0.01 to 100, default "
                  "0.25")
      .type_name("PX");
  command.add_option("--count", options->count, "About so many pieces of equal size instead, whatever the error")
      .type_name("N");
  command
      .add_option("--model", options->model,
                  "Fit this model to the camera, with all of its parameters or those named, and say how far its "
                  "pixels are off")
      .type_name("MODEL[:PARAMETER,...]");
  command.add_option("-o,--output", options->output, "Write the camera as a calibration file").type_name("FILE");
  command
      .add_option("--format", options->format,
                  "The file's format where its extension leaves a choice: opencv, ros, kalibr, basalt, colmap, "
                  "nerfstudio")
      .type_name("FORMAT");
  add_limits(command, options->reading);
  command.add_flag("--json", options->json, "Print JSON");
  command.footer(
      "Examples:\n"
      "  omma camera equidistant:fov_deg=180 --size 1024x1024\n"
      "  omma camera equisolid:fov_deg=220 --project 1,0,-1 --project -1,0,0.2\n"
      "  omma camera cylinder:fov_deg=360 --unproject 0,600 --rays rays.npy --json\n"
      "  omma camera equirectangular --pieces pieces.json --tolerance 0.1\n"
      "  omma camera camchain.yaml#cam1 --model double_sphere -o rig.yaml --format kalibr");
  command.callback([options] { run(*options); });
}

}  // namespace omma::tool
