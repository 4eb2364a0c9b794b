#include "omma/scene/scene.h"

#include <algorithm>
#include <filesystem>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {

Bounds Mesh::bounds() const {
  Bounds result;
  for (const glm::uvec3& triangle : triangles) {
    for (int corner = 0; corner < 3; ++corner) result.add(glm::dvec3(positions[triangle[corner]]));
  }
  return result;
}

size_t Scene::triangle_count() const {
  size_t count = 0;
  for (const Instance& instance : instances) count += meshes[instance.mesh].triangles.size();
  return count;
}

Bounds Scene::bounds() const {
  std::vector<Bounds> of_mesh;
  of_mesh.reserve(meshes.size());
  for (const Mesh& mesh : meshes) of_mesh.push_back(mesh.bounds());
  Bounds result;
  for (const Instance& instance : instances) {
    result.add(of_mesh[instance.mesh].transformed(instance.worldFromObject));
  }
  return result;
}

void number_triangles(Scene& scene) {
  uint32_t first = 0;
  for (Instance& instance : scene.instances) {
    instance.first_triangle = first;
    first += static_cast<uint32_t>(scene.meshes[instance.mesh].triangles.size());
  }
}

void finish_scene(Scene& scene) {
  scene.next_key = 0;
  for (Instance& instance : scene.instances) instance.key = scene.next_key++;
  number_triangles(scene);
  for (Mesh& mesh : scene.meshes) {
    if (!mesh.skin && mesh.morph_targets.empty()) continue;
    mesh.rest_positions = mesh.positions;
    mesh.rest_normals = mesh.normals;
    mesh.rest_tangents = mesh.tangents;
  }
  set_time(scene, 0.0);
}

namespace {

Scene make_builtin(const BuiltinScene& builtin, const Spec& spec) {
  std::vector<std::string> keys;
  std::vector<double> values;
  for (const BuiltinParameter& parameter : builtin.parameters) {
    keys.push_back(parameter.name);
    const auto given = spec.values.find(parameter.name);
    if (given == spec.values.end()) {
      values.push_back(parameter.default_value);
      continue;
    }
    const std::string what = spec.name + ": " + parameter.name;
    const long value = parse_integer(what, given->second);
    if (value < parameter.min || value > parameter.max) {
      throw CommandError("{} is {}, but must lie between {} and {}", what, value, parameter.min, parameter.max);
    }
    values.push_back(static_cast<double>(value));
  }
  for (const auto& [key, value] : spec.values) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      throw CommandError("{}", unknown_name("parameter of scene '" + spec.name + "'", key, keys));
    }
  }
  return builtin.make(values);
}

}  // namespace

Scene load_scene(std::string_view text, const ReadOptions& options) {
  const std::string_view name = text.substr(0, text.find(':'));
  const std::filesystem::path path(text);
  if (path.has_extension() && std::filesystem::path(name).has_extension()) {
    return load_scene_file(path, options);
  }
  if (name.find('/') != std::string_view::npos) return load_scene_file(path, options);

  const Spec spec = parse_spec(text);
  std::vector<std::string> names;
  for (const BuiltinScene& builtin : builtin_scenes()) {
    if (builtin.name == spec.name) return make_builtin(builtin, spec);
    names.push_back(builtin.name);
  }
  throw CommandError("{}, nor is it a file with an extension that tells its format",
                     unknown_name("scene", spec.name, names));
}

}  // namespace omma
