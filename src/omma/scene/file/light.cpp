// Lights and cameras of a file. Each gets a node of its own below the one it hangs on, looking along -Z.
#include <algorithm>
#include <cmath>

#include "omma/math/pose.h"
#include "omma/scene/file/import.h"

namespace omma::file {
namespace {

constexpr double pi = 3.14159265358979323846;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A node at `position` of the node called `name`, whose -Z is `direction`. Returns its index, or -1 when any of them
/// is not finite.
int add_aimed_node(Import& import, const aiString& name, const aiVector3D& position, const aiVector3D& direction,
                   const aiVector3D& up) {
  const auto parent = import.node_of_name.find(name.C_Str());
  glm::dvec3 from = to_dvec3(position), along = to_dvec3(direction), above = to_dvec3(up);
  if (import.gltf) {
    // By definition there; assimp repeats the node's translation in a camera's position.
    from = glm::dvec3(0.0);
    along = {0.0, 0.0, -1.0};
    above = {0.0, 1.0, 0.0};
  }
  if (!finite(from) || !finite(along) || !finite(above)) return -1;
  if (glm::length(along) == 0.0) along = {0.0, 0.0, -1.0};
  if (glm::length(above) == 0.0) above = {0.0, 1.0, 0.0};
  const glm::dmat4 parentFromNode = look_at_worldFromCamera(from, from + glm::normalize(along), above);
  Node node;
  node.name = name.C_Str();
  node.parent = parent == import.node_of_name.end() ? 0 : parent->second;
  node.translation = from;
  node.rotation = glm::quat_cast(glm::dmat3(parentFromNode));
  import.scene.nodes.push_back(std::move(node));
  return static_cast<int>(import.scene.nodes.size()) - 1;
}

/// glTF gives lux and candela, taken for irradiance and intensity as they are: 1 is 1.
///
/// The others give a colour without a unit, meant for the old model in which a white surface facing the light shows
/// exactly that colour, or that over constant + linear d + quadratic d². A white surface reflects irradiance / pi, so
/// suns shine with pi times the colour, and points are made equal to the file's model at `distance`, since light here
/// always falls with the square.
glm::vec3 power(const Import& import, const aiLight& source, double distance) {
  const glm::vec3 color = to_vec3(source.mColorDiffuse);
  if (import.gltf) return color;
  if (source.mType == aiLightSource_DIRECTIONAL) return color * static_cast<float>(pi);
  const double falloff = source.mAttenuationConstant + source.mAttenuationLinear * distance +
                         source.mAttenuationQuadratic * distance * distance;
  return color * static_cast<float>(pi * distance * distance / (falloff > 0.0 ? falloff : 1.0));
}

/// assimp keeps KHR_lights_punctual's range in the node's metadata.
float light_range(const Import& import, const aiLight& source) {
  const aiNode* node = import.source.mRootNode->FindNode(source.mName);
  float range = 0.0f;
  if (node && node->mMetaData) node->mMetaData->Get("PBR_LightRange", range);
  return std::isfinite(range) && range > 0.0f ? range : 0.0f;
}

/// How far a light is from the middle of the scene, or a quarter of the scene's radius where it is nearer.
double distance_to_scene(const Scene& scene, const Bounds& bounds, int light_node) {
  const Node& node = scene.nodes[light_node];
  const glm::dvec3 position(scene.nodes[node.parent].worldFromNode * glm::dvec4(node.translation, 1.0));
  const double radius = std::max(0.5 * glm::length(bounds.extent()), 1e-6);
  return std::clamp(glm::distance(position, bounds.center()), 0.25 * radius, radius);
}

void import_light(Import& import, const aiLight& source, const Bounds& bounds) {
  if (source.mType == aiLightSource_AMBIENT) {
    const glm::vec3 ambient = glm::max(to_vec3(source.mColorAmbient), to_vec3(source.mColorDiffuse));
    if (finite(ambient)) import.scene.ambient = glm::max(ambient, glm::vec3(0.0f));
    return;
  }
  Light light;
  switch (source.mType) {
    case aiLightSource_DIRECTIONAL:
      light.kind = Light::Kind::sun;
      break;
    case aiLightSource_SPOT:
      light.kind = Light::Kind::spot;
      break;
    default:
      light.kind = Light::Kind::point;  // an area light, seen from afar
  }
  light.name = source.mName.C_Str();
  light.range = light_range(import, source);
  if (light.kind == Light::Kind::spot) {
    // glTF's cone angles are from the axis, and so are assimp's of glTF; elsewhere assimp has the whole cone.
    const float share = import.gltf ? 1.0f : 0.5f;
    const float outer = source.mAngleOuterCone * share, inner = source.mAngleInnerCone * share;
    light.outer_angle = std::isfinite(outer) ? std::clamp(outer, 1e-3f, 1.5707963f) : 0.785398f;
    light.inner_angle = std::isfinite(inner) ? std::clamp(inner, 0.0f, light.outer_angle) : 0.0f;
  }
  light.node = add_aimed_node(import, source.mName, source.mPosition, source.mDirection, source.mUp);
  if (light.node < 0) return;
  light.color = glm::max(power(import, source, distance_to_scene(import.scene, bounds, light.node)), glm::vec3(0.0f));
  if (finite(light.color)) import.scene.lights.push_back(std::move(light));
}

}  // namespace

void import_lights_and_cameras(Import& import) {
  // Positions are wanted for the scene's size, and nothing has moved to its place yet.
  set_time(import.scene, 0.0);
  const Bounds bounds = import.scene.bounds();
  for (unsigned i = 0; i < import.source.mNumLights; ++i) {
    import_light(import, *import.source.mLights[i], bounds);
  }
  for (unsigned i = 0; i < import.source.mNumCameras; ++i) {
    const aiCamera& source = *import.source.mCameras[i];
    SceneCamera camera;
    camera.name = source.mName.C_Str();
    camera.node = add_aimed_node(import, source.mName, source.mPosition, source.mLookAt, source.mUp);
    if (camera.node >= 0) import.scene.cameras.push_back(std::move(camera));
  }
}

}  // namespace omma::file
