// omma probe: what points of a scene see of their hemispheres.
#include <fmt/core.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "arguments.h"
#include "commands.h"
#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/probe/probe_file.h"
#include "omma/scene/object.h"
#include "omma/technique/registry.h"
#include "progress.h"
#include "reading.h"

namespace omma::tool {
namespace {

using Json = nlohmann::ordered_json;

/// As typed.
struct ProbeCommand {
  std::string scene, technique = "visibility";
  Text at, normal, points, vertices, size, max_distance, offset, background, shadows, shadow_size, time, output;
  ReadingOptions reading;
  bool json = false;
};

ProbeOptions probe_options_of(const ProbeCommand& command) {
  ProbeOptions options;
  if (command.size) options.size = count_of("--size", *command.size, 8, 4096);
  if (command.max_distance) options.max_distance = number_of("--max-distance", *command.max_distance, 1e-6, 1e9);
  if (command.offset) options.offset = number_of("--offset", *command.offset, 0.0, 1e6);
  options.render.technique = command.technique;
  if (command.background) options.render.background = background_of(*command.background);
  set_shadows(options.render, command.shadows, command.shadow_size);
  choose_technique(command.technique, make_camera("orthographic_fisheye:fov_deg=180"));
  return options;
}

Json json_of(const ProbePoint& point, const ProbeResult& result) {
  const auto list = [](const glm::dvec3& v) { return Json{v.x, v.y, v.z}; };
  return {{"at", list(point.position)},
          {"normal", list(point.normal)},
          {"occlusion", result.occlusion},
          {"sky", result.sky},
          {"irradiance", list(result.irradiance)},
          {"open_solid_angle_sr", result.open_solid_angle}};
}

void print_text(const ProbeResult& result) {
  fmt::print("occlusion         {:.4f}   of the cosine-weighted hemisphere\n", result.occlusion);
  fmt::print("sky               {:.4f}\n", result.sky);
  fmt::print("irradiance        {:.4f} {:.4f} {:.4f}   linear RGB\n", result.irradiance.x, result.irradiance.y,
             result.irradiance.z);
  fmt::print("open solid angle  {:.4f} sr   of {:.4f}\n", result.open_solid_angle, 2.0 * 3.14159265358979);
}

/// Exactly one of --at, --points and --vertices says where.
void require_one_place(const ProbeCommand& command) {
  const int places = int(command.at.has_value()) + int(command.points.has_value()) + int(command.vertices.has_value());
  if (places != 1) throw CommandError("where? one of --at X,Y,Z, --points FILE.npy and --vertices OBJECT says it");
  if (command.at && !command.normal) throw CommandError("--at needs --normal X,Y,Z, the way the point looks");
  if (command.vertices && command.normal)
    throw CommandError("--vertices have normals of their own; leave --normal out");
  if (!command.at && !command.output)
    throw CommandError("a list of points needs a file to go to: -o FILE.npy or FILE.ply");
}

ProbeMesh places_of(const ProbeCommand& command, const std::optional<glm::dvec3>& normal, const Limits& limits) {
  ProbeMesh places;
  if (command.at) {
    places.points.push_back({vector3_of("--at", *command.at), *normal});
    check_probe_point(places.points.front());
  }
  if (command.points) places.points = load_probe_points(*command.points, normal, limits);
  return places;
}

void run(const ProbeCommand& command) {
  require_one_place(command);
  const ProbeOptions options = probe_options_of(command);
  const ReadOptions reading = read_options_of(command.reading);
  std::optional<glm::dvec3> normal;
  if (command.normal) normal = vector3_of("--normal", *command.normal);
  if (normal && *normal == glm::dvec3(0.0)) throw CommandError("--normal {}: has no direction", *command.normal);
  if (command.output) check_probe_output(*command.output);
  ProbeMesh places = places_of(command, normal, reading.limits);

  Scene scene = load_scene(command.scene, reading);
  if (command.time) set_time(scene, parse_number("--time", *command.time));
  if (command.vertices) places = object_mesh(scene, find_object(scene, *command.vertices));
  const PreparedScene prepared(Device(), std::move(scene));
  Prober prober(prepared, options);
  std::vector<ProbeResult> results(places.points.size());
  const auto begin = std::chrono::steady_clock::now();
  {
    const bool list = results.size() > 1;
    std::optional<Progress> progress;
    if (list) progress.emplace("pictures", int(2 * results.size()));
    for (size_t i = 0; i < results.size(); ++i) {
      prober.look_cosine_weighted(places.points[i], results[i]);
      if (list) progress->step();
    }
    for (size_t i = 0; i < results.size(); ++i) {
      prober.look_unweighted(places.points[i], results[i]);
      if (list) progress->step();
    }
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (command.output) {
    write_probes(*command.output, places.points, results, places.triangles);
    fmt::print(stderr, "{}: {} points, {:.1f} a second\n", *command.output, results.size(),
               double(results.size()) / std::max(seconds, 1e-9));
  }
  if (!command.at) return;
  if (command.json) {
    fmt::print("{}\n", json_of(places.points.front(), results.front()).dump(2));
  } else {
    print_text(results.front());
  }
}

}  // namespace

void add_probe(const Command& tool) {
  const Command command = tool.add_command("probe", "Ambient occlusion, sky and irradiance at points of a scene");
  auto options = std::make_shared<ProbeCommand>();
  command.add_option("scene", options->scene, "A file that assimp reads, or a built-in scene (see 'omma scenes')")
      .type_name("SCENE")
      .required();
  const auto add = [&](const char* group, const char* name, const char* type, auto& value, const char* description) {
    command.add_option(name, value, description).type_name(type).group(group);
  };
  const char* where = "Where (one of --at, --points, --vertices)";
  add(where, "--at", "X,Y,Z", options->at, "A point, world metres");
  add(where, "--points", "FILE.npy", options->points, "Many: K x 6, positions and normals, or K x 3 with --normal");
  add(where, "--vertices", "OBJECT", options->vertices, "The vertices of an object, by its node's name or its number");
  add(where, "--normal", "X,Y,Z", options->normal, "The way the surface looks there; any length but zero");
  add(where, "--offset", "METRES", options->offset, "How far along the normal it is looked from, default 0.001");
  add(where, "--time", "SECONDS", options->time, "Of the scene's animation");
  const char* how = "How";
  add(how, "--size", "N", options->size, "Pixels along each hemisphere's picture, 8 to 4096, default 64");
  add(how, "--max-distance", "METRES", options->max_distance, "Beyond it nothing occludes, default no limit");
  add(how, "--technique", "T[:VARIANT]", options->technique, "How to draw, default visibility (see 'omma techniques')");
  add(how, "--background", "sky|R,G,B", options->background,
      "Radiance where nothing is: a sky (default) or linear RGB");
  add(how, "--shadows", "KIND", options->shadows, "Lights cast shadows: paraboloid or cube maps, default off");
  add(how, "--shadow-size", "N", options->shadow_size, "Texels along a shadow map, default 1024");
  add_root(command, options->reading);
  add_limits(command, options->reading);
  const char* result = "Result";
  add(result, "-o,--output", "FILE", options->output, ".npy (columns: see docs/probes.md) or .ply");
  command.add_flag("--json", options->json, "For --at: print JSON").group(result);
  command.footer(
      "Examples:\n"
      "  omma probe temple --at 0,1.2,20 --normal 0,1,0\n"
      "  omma probe room --vertices pot --max-distance 1 -o pot.ply");
  command.callback([options] { run(*options); });
}

}  // namespace omma::tool
