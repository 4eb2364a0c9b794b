// Brings a scene to a moment: nodes first, then what hangs on them.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/scene/scene.h"

namespace omma {
namespace {

glm::dvec3 interpolate(const glm::dvec3& a, const glm::dvec3& b, double t) { return glm::mix(a, b, t); }

glm::dquat interpolate(const glm::dquat& a, const glm::dquat& b, double t) {
  return glm::slerp(a, b, t);  // the shorter way round
}

std::vector<float> interpolate(const std::vector<float>& a, const std::vector<float>& b, double t) {
  std::vector<float> result = a;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    result[i] = static_cast<float>(a[i] + (b[i] - a[i]) * t);
  }
  return result;
}

/// The value at `time`; `keys` is not empty.
template <typename T>
T sample(const Keys<T>& keys, double time) {
  const auto after = std::upper_bound(keys.times.begin(), keys.times.end(), time);
  if (after == keys.times.begin()) return keys.values.front();
  const size_t next = static_cast<size_t>(after - keys.times.begin());
  if (next == keys.times.size() || keys.step) return keys.values[next - 1];
  const double begin = keys.times[next - 1];
  return interpolate(keys.values[next - 1], keys.values[next], (time - begin) / (keys.times[next] - begin));
}

glm::dmat4 transform(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
  glm::dmat4 result = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) result[axis] *= scale[axis];
  result[3] = glm::dvec4(translation, 1.0);
  return result;
}

/// Rotation and translation only. An axis that a scale of zero took away is chosen anew.
glm::dmat4 without_scale(const glm::dmat4& matrix) {
  glm::dvec3 back(matrix[2]);
  glm::dvec3 up(matrix[1]);
  back = glm::length(back) > 0.0 ? glm::normalize(back) : glm::dvec3(0, 0, 1);
  glm::dvec3 right = glm::cross(up, back);
  if (glm::length(right) < 1e-12 * glm::length(up) || glm::length(up) == 0.0) {
    right = glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), back);
  }
  right = glm::normalize(right);
  return glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0), matrix[3]);
}

const Animation* find_animation(const Scene& scene, std::string_view name) {
  if (name.empty()) return scene.animations.empty() ? nullptr : &scene.animations.front();
  std::vector<std::string> names;
  for (const Animation& animation : scene.animations) {
    if (animation.name == name) return &animation;
    names.push_back(animation.name);
  }
  if (names.empty()) {
    throw CommandError("animation '{}' was asked for, but scene '{}' has no animation", name, scene.name);
  }
  throw CommandError("{}", unknown_name("animation", name, names));
}

void move_nodes(Scene& scene, const Animation* animation, double time) {
  std::vector<const NodeAnimation*> animation_of_node(scene.nodes.size(), nullptr);
  if (animation) {
    for (const NodeAnimation& node : animation->nodes) animation_of_node[node.node] = &node;
  }
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    Node& node = scene.nodes[i];
    glm::dmat4 parentFromNode;
    if (const NodeAnimation* moved = animation_of_node[i]) {
      parentFromNode = transform(moved->translation.times.empty() ? node.translation : sample(moved->translation, time),
                                 moved->rotation.times.empty() ? node.rotation : sample(moved->rotation, time),
                                 moved->scale.times.empty() ? node.scale : sample(moved->scale, time));
    } else {
      parentFromNode = node.matrix ? *node.matrix : transform(node.translation, node.rotation, node.scale);
    }
    node.worldFromNode = node.parent < 0 ? parentFromNode : scene.nodes[node.parent].worldFromNode * parentFromNode;
  }
}

void morph(Mesh& mesh, const std::vector<float>& weights) {
  for (size_t target_index = 0; target_index < mesh.morph_targets.size(); ++target_index) {
    const MorphTarget& target = mesh.morph_targets[target_index];
    const float weight = target_index < weights.size() ? weights[target_index] : target.weight;
    if (weight == 0.0f) continue;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      mesh.positions[i] += weight * target.position_offsets[i];
      if (!target.normal_offsets.empty()) mesh.normals[i] += weight * target.normal_offsets[i];
    }
  }
  for (size_t i = 0; i < mesh.normals.size(); ++i) {
    const float length = glm::length(mesh.normals[i]);
    mesh.normals[i] = length > 1e-12f ? mesh.normals[i] / length : mesh.rest_normals[i];
  }
}

glm::vec3 unit_or(const glm::dvec3& vector, const glm::vec3& otherwise) {
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

/// From the mesh's frame into the world, by joints where they have a hold and by the node where none has.
void skin(Mesh& mesh, const std::vector<Node>& nodes, const glm::dmat4& worldFromNode) {
  std::vector<glm::dmat4> worldFromMesh;
  for (const Skin::Joint& joint : mesh.skin->joints) {
    worldFromMesh.push_back(nodes[joint.node].worldFromNode * joint.jointFromMesh);
  }
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::u16vec4 joints = mesh.skin->vertex_joints[i];
    const glm::vec4 weights = mesh.skin->vertex_weights[i];
    glm::dmat4 blended(0.0);
    double total = 0.0;
    for (int k = 0; k < 4; ++k) {
      if (weights[k] <= 0.0f) continue;
      blended += worldFromMesh[joints[k]] * static_cast<double>(weights[k]);
      total += weights[k];
    }
    if (total == 0.0) blended = worldFromNode;

    mesh.positions[i] = glm::vec3(blended * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
    // Cofactors: the inverse transpose times the determinant, defined for singular matrices too. The determinant's
    // sign must go, or a mirrored joint would turn normals inside out.
    const glm::dvec3 x(blended[0]), y(blended[1]), z(blended[2]);
    const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    const double sign = glm::dot(x, cofactors[0]) < 0.0 ? -1.0 : 1.0;
    mesh.normals[i] = unit_or(cofactors * glm::dvec3(mesh.normals[i]) * sign, mesh.normals[i]);
    if (!mesh.tangents.empty()) {
      const glm::vec3 tangent(mesh.tangents[i]);
      mesh.tangents[i] = glm::vec4(unit_or(glm::dmat3(blended) * glm::dvec3(tangent), tangent), mesh.tangents[i].w);
    }
  }
}

void move_instances(Scene& scene, const Animation* animation, double time) {
  std::vector<bool> deformed(scene.meshes.size(), false);
  for (Instance& instance : scene.instances) {
    if (instance.node < 0) continue;
    const glm::dmat4& worldFromNode = scene.nodes[instance.node].worldFromNode;
    Mesh& mesh = scene.meshes[instance.mesh];
    instance.worldFromObject = mesh.skin ? glm::dmat4(1.0) : worldFromNode;
    if (!mesh.deforms() || deformed[instance.mesh]) continue;
    deformed[instance.mesh] = true;

    mesh.positions = mesh.rest_positions;
    mesh.normals = mesh.rest_normals;
    mesh.tangents = mesh.rest_tangents;
    if (!mesh.morph_targets.empty()) {
      std::vector<float> weights;
      if (animation) {
        for (const MorphAnimation& moved : animation->morphs) {
          if (moved.node == instance.node) weights = sample(moved.weights, time);
        }
      }
      morph(mesh, weights);
    }
    if (mesh.skin) skin(mesh, scene.nodes, worldFromNode);
  }
}

}  // namespace

SceneChanges set_time(Scene& scene, double seconds, std::string_view animation_name) {
  if (!std::isfinite(seconds)) throw CommandError("time must be finite, not {}", seconds);
  const Animation* animation = find_animation(scene, animation_name);
  double time = 0.0;
  if (animation && animation->duration > 0.0) {
    time = seconds - std::floor(seconds / animation->duration) * animation->duration;
  }
  move_nodes(scene, animation, time);
  move_instances(scene, animation, time);
  for (Light& light : scene.lights) {
    if (light.node < 0) continue;
    const glm::dmat4 worldFromLight = without_scale(scene.nodes[light.node].worldFromNode);
    light.position = glm::dvec3(worldFromLight[3]);
    light.direction = -glm::dvec3(worldFromLight[2]);
  }
  for (SceneCamera& camera : scene.cameras) {
    if (camera.node >= 0) {
      camera.worldFromCamera = without_scale(scene.nodes[camera.node].worldFromNode);
    }
  }
  SceneChanges changes{.moved = true, .lights = true};
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m].deforms()) changes.deformed.insert(int(m));
  }
  return changes;
}

}  // namespace omma
