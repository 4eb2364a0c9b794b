// omma camera: what a camera is, where points land in its image, which way its pixels look.
#include "omma/camera/camera.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <array>
#include <nlohmann/json.hpp>

#include "arguments.h"
#include "commands.h"
#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/camera/field_of_view.h"
#include "omma/image/npy.h"

namespace omma::tool {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees_per_radian = 180.0 / 3.14159265358979323846;

/// As typed.
struct Options {
  std::string camera;
  Text size, rays;
  std::vector<std::string> project, unproject;
  bool json = false;
};

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json describe(const Camera& camera) {
  const ImageSize size = camera.size();
  const FieldOfView fov = field_of_view(camera);
  Json json{{"camera", to_text(camera)}, {"width", size.width}, {"height", size.height}};
  if (const Lens* lens = camera.lens()) {
    json["model"] = lens->model->info.name;
    json["formula"] = lens->model->info.formula;
    json["focal_px"] = {lens->focal.x, lens->focal.y};
    json["centre_px"] = {lens->centre.x, lens->centre.y};
    json["max_angle_deg"] = lens->parameters.max_angle * degrees_per_radian;
  } else {
    json["model"] = "ray map";
  }
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

std::string value_text(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& element : value) text += (text.empty() ? "" : ",") + value_text(element);
  return text;
}

void print_text(const Json& json) {
  for (const auto& [key, value] : json.items()) {
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
  std::optional<ImageSize> size;
  if (options.size) size = size_of("--size", *options.size);
  const Camera camera = make_camera(options.camera, size);
  Json json = describe(camera);
  if (!options.project.empty()) json["project"] = projections(camera, options);
  if (!options.unproject.empty()) json["unproject"] = unprojections(camera, options);
  if (options.rays) write_rays(*options.rays, camera);
  if (options.json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_text(json);
  }
}

}  // namespace

void add_camera(CLI::App& tool) {
  CLI::App* command = tool.add_subcommand("camera", "Describe a camera; project and unproject points");
  auto options = std::make_shared<Options>();
  command->add_option("camera", options->camera, "A lens with its parameters, or a .npy ray map (see 'omma cameras')")
      ->type_name("CAMERA")
      ->required();
  command->add_option("--size", options->size, "Pixels, default 1600x1200 or the camera's own")->type_name("WxH");
  command
      ->add_option("--project", options->project,
                   "Where this direction lands in the image (camera frame: +X right, +Y up, looks along -Z)")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false);
  command
      ->add_option("--unproject", options->unproject,
                   "Which way this point of the image looks (pixels from the top left corner, y down; the first "
                   "pixel's centre is 0.5,0.5)")
      ->type_name("U,V")
      ->allow_extra_args(false);
  command->add_option("--rays", options->rays, "Write the direction of every pixel, H x W x 3 float32: a ray map")
      ->type_name("FILE.npy");
  command->add_flag("--json", options->json, "Print JSON");
  command->footer(
      "Examples:\n"
      "  omma camera equidistant:fov_deg=180 --size 1024x1024\n"
      "  omma camera equisolid:fov_deg=220 --project 1,0,-1 --project -1,0,0.2\n"
      "  omma camera cylinder:fov_deg=360 --unproject 0,600 --rays rays.npy --json");
  command->callback([options] { run(*options); });
}

}  // namespace omma::tool
