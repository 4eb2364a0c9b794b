#include "omma/scene/edit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "omma/base/error.h"

namespace omma {
namespace {

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_finite(std::span<const glm::vec3> values, const char* what) {
  for (size_t i = 0; i < values.size(); ++i) {
    if (!is_finite(values[i])) throw CommandError("{} {} is not finite", what, i);
  }
}

void check_transform(const glm::dmat4& worldFromObject) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(worldFromObject[column][row])) throw CommandError("a transform that is not finite");
    }
  }
  if (glm::transpose(worldFromObject)[3] != glm::dvec4(0, 0, 0, 1)) {
    throw CommandError("a transform whose last row is not 0 0 0 1; instances are moved, turned and scaled only");
  }
}

/// Ids are whole numbers of 32 bits.
void check_triangles(size_t count) {
  constexpr size_t most = std::numeric_limits<int32_t>::max();
  if (count > most) throw CommandError("the scene would have {} triangles; {} can be numbered", count, most);
}

void check_number(int number, size_t count, const char* what) {
  if (number < 0 || size_t(number) >= count) {
    throw CommandError("{} {} is not in the scene, which has {} of them", what, number, count);
  }
}

}  // namespace

SceneEdit::SceneEdit(Scene& scene, SceneChanges& changes) : scene_(scene), changes_(changes) {}

void SceneEdit::set_time(double seconds, std::string_view animation) {
  changes_ += omma::set_time(scene_, seconds, animation);
}

Instance& SceneEdit::find(uint32_t instance) {
  // Keys rise along the list: later ones come at its end.
  const auto found = std::ranges::lower_bound(scene_.instances, instance, {}, &Instance::key);
  if (found == scene_.instances.end() || found->key != instance) {
    throw CommandError("instance {} is not in the scene: it was removed, or never was", instance);
  }
  return *found;
}

Mesh& SceneEdit::find_mesh(int mesh) {
  check_number(mesh, scene_.meshes.size(), "mesh");
  return scene_.meshes[size_t(mesh)];
}

void SceneEdit::move(uint32_t instance, const glm::dmat4& worldFromObject) {
  Instance& moved = find(instance);
  check_transform(worldFromObject);
  if (scene_.meshes[size_t(moved.mesh)].skin) {
    throw CommandError("instance {} has a skin and stands where its joints are; it cannot be moved", instance);
  }
  moved.worldFromObject = worldFromObject;
  changes_.moved = true;
}

uint32_t SceneEdit::add_instance(int mesh, const glm::dmat4& worldFromObject, int object) {
  const Mesh& shown = find_mesh(mesh);
  check_transform(worldFromObject);
  if (object < 0) throw CommandError("object {}; numbers from 0 on are possible", object);
  if (shown.deforms()) {
    throw CommandError("mesh '{}' has a skin or morph targets and stands where its node is; it has no other instance",
                       shown.name);
  }
  check_triangles(scene_.triangle_count() + shown.triangles.size());
  Instance instance;
  instance.mesh = mesh;
  instance.node = -1;
  instance.object = object;
  instance.key = scene_.next_key++;
  instance.worldFromObject = worldFromObject;
  if (!scene_.instances.empty()) {
    const Instance& last = scene_.instances.back();
    instance.first_triangle = last.first_triangle + uint32_t(scene_.meshes[size_t(last.mesh)].triangles.size());
  }
  scene_.instances.push_back(instance);
  changes_.listed = true;
  return instance.key;
}

void SceneEdit::remove_instance(uint32_t instance) {
  scene_.instances.erase(scene_.instances.begin() + (&find(instance) - scene_.instances.data()));
  number_triangles(scene_);
  changes_.listed = true;
}

void SceneEdit::set_vertices(int mesh, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) {
  Mesh& changed = find_mesh(mesh);
  const auto check_count = [&](size_t count, const char* what) {
    if (count != changed.positions.size()) {
      throw CommandError("{} {} for mesh {} '{}', which has {} vertices; replace_mesh takes another number", count,
                         what, mesh, changed.name, changed.positions.size());
    }
  };
  if (changed.deforms()) {
    throw CommandError("mesh {} '{}' has a skin or morph targets, which move its vertices", mesh, changed.name);
  }
  check_count(positions.size(), "positions");
  if (!normals.empty()) check_count(normals.size(), "normals");
  check_finite(positions, "position");
  check_finite(normals, "normal");
  // What was not finite was left out when the mesh was sorted.
  (std::ranges::all_of(changed.positions, is_finite) ? changes_.deformed : changes_.replaced).insert(mesh);
  std::ranges::copy(positions, changed.positions.begin());
  std::ranges::copy(normals, changed.normals.begin());
}

void SceneEdit::check(const Mesh& mesh) const {
  if (mesh.skin || !mesh.morph_targets.empty() || mesh.deforms()) {
    throw CommandError("mesh '{}' has a skin, morph targets or a rest pose; a host moves vertices by set_vertices",
                       mesh.name);
  }
  check_number(mesh.material, scene_.materials.size(), "material");
  const size_t vertices = mesh.positions.size();
  const auto check_count = [&](size_t count, const char* what, bool may_lack) {
    if (count == vertices || (may_lack && count == 0)) return;
    throw CommandError("mesh '{}' has {} positions and {} {}", mesh.name, vertices, count, what);
  };
  check_count(mesh.normals.size(), "normals", false);
  check_count(mesh.tangents.size(), "tangents", true);
  check_count(mesh.uvs.size(), "texture coordinates", true);
  check_count(mesh.colors.size(), "colours", true);
  check_finite(mesh.positions, "position");
  check_finite(mesh.normals, "normal");
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      if (mesh.triangles[t][corner] >= vertices) {
        throw CommandError("triangle {} of mesh '{}' names vertex {} of {}", t, mesh.name, mesh.triangles[t][corner],
                           vertices);
      }
    }
  }
}

int SceneEdit::add_mesh(Mesh mesh) {
  check(mesh);
  scene_.meshes.push_back(std::move(mesh));
  const int number = int(scene_.meshes.size()) - 1;
  changes_.replaced.insert(number);
  return number;
}

void SceneEdit::replace_mesh(int mesh, Mesh with) {
  Mesh& changed = find_mesh(mesh);
  check(with);
  if (changed.deforms()) throw CommandError("mesh {} '{}' has a skin or morph targets", mesh, changed.name);
  const auto users = size_t(std::ranges::count(scene_.instances, mesh, &Instance::mesh));
  check_triangles(scene_.triangle_count() + users * with.triangles.size() - users * changed.triangles.size());
  changed = std::move(with);
  number_triangles(scene_);
  changes_.replaced.insert(mesh);
  changes_.listed = true;
}

int SceneEdit::add_texture(Texture texture) {
  if (texture.width < 1 || texture.height < 1 ||
      texture.texels.size() != size_t(texture.width) * size_t(texture.height)) {
    throw CommandError("texture '{}' of {} x {} has {} texels", texture.name, texture.width, texture.height,
                       texture.texels.size());
  }
  scene_.textures.push_back(std::move(texture));
  changes_.textures = true;
  return int(scene_.textures.size()) - 1;
}

void SceneEdit::check(const Material& material) const {
  if (!std::isfinite(material.alpha_cutoff) || !std::isfinite(material.roughness)) {
    throw CommandError("material '{}' has a number that is not finite", material.name);
  }
  for (const int texture : {material.base_color_texture, material.normal_texture, material.metallic_roughness_texture,
                            material.emissive_texture}) {
    if (texture != -1) check_number(texture, scene_.textures.size(), "texture");
  }
}

int SceneEdit::add_material(const Material& material) {
  check(material);
  scene_.materials.push_back(material);
  changes_.materials = true;
  return int(scene_.materials.size()) - 1;
}

void SceneEdit::set_material(int material, const Material& with) {
  check_number(material, scene_.materials.size(), "material");
  check(with);
  Material& changed = scene_.materials[size_t(material)];
  // What programs, trees and lists of draws were made by.
  const auto kind = [](const Material& of) {
    return std::tuple(of.alpha, of.double_sided, of.unlit, of.base_color_texture, of.normal_texture,
                      of.metallic_roughness_texture, of.emissive_texture);
  };
  changes_.listed |= kind(changed) != kind(with);
  changes_.materials = true;
  changed = with;
}

void SceneEdit::set_lights(std::vector<Light> lights) {
  for (const Light& light : lights) {
    if (light.node != -1) check_number(light.node, scene_.nodes.size(), "node");
    const double reach = glm::length(light.direction) + glm::length(light.position) + double(glm::length(light.color)) +
                         double(light.range) + double(light.inner_angle) + double(light.outer_angle);
    if (!std::isfinite(reach)) throw CommandError("light '{}' has a number that is not finite", light.name);
    if (light.kind != Light::Kind::point && glm::length(light.direction) == 0.0) {
      throw CommandError("light '{}' shines in no direction", light.name);
    }
  }
  scene_.lights = std::move(lights);
  changes_.lights = true;
}

void SceneEdit::set_ambient(const glm::vec3& ambient) {
  if (!is_finite(ambient)) throw CommandError("ambient light that is not finite");
  scene_.ambient = ambient;
  changes_.lights = true;
}

}  // namespace omma
