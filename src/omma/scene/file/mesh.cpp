// Vertices, triangles, skins and morph targets of a file's mesh.
#include <algorithm>
#include <cmath>
#include <glm/gtc/color_space.hpp>

#include "omma/base/error.h"
#include "omma/scene/file/import.h"
#include "omma/scene/geometry.h"

namespace omma::file {
namespace {

/// Faces that meet at less than this are smooth where the file has no normals, in radians: 45 degrees keeps a
/// cube's edges and rounds a bunny.
constexpr float crease = 0.785398f;

void import_triangles(Import& import, const aiMesh& source, Mesh& mesh) {
  for (unsigned f = 0; f < source.mNumFaces; ++f) {
    const aiFace& face = source.mFaces[f];
    if (face.mNumIndices != 3) {
      ++import.repairs.points_and_lines;
      continue;
    }
    mesh.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
  }
}

glm::u8vec4 import_color(const aiColor4D& source, bool linear) {
  glm::vec4 color(source.r, source.g, source.b, source.a);
  for (int i = 0; i < 4; ++i) {
    color[i] = std::isfinite(color[i]) ? std::clamp(color[i], 0.0f, 1.0f) : 0.0f;
  }
  // Scanned and painted PLY, OBJ and FBX vertex colours are picture values; only glTF says that its are linear.
  if (!linear) color = glm::vec4(glm::convertSRGBToLinear(glm::vec3(color)), color.a);
  return glm::u8vec4(color * 255.0f + 0.5f);
}

void import_vertices(const aiMesh& source, unsigned uv_channel, bool gltf, Mesh& mesh) {
  const unsigned count = source.mNumVertices;
  mesh.positions.reserve(count);
  for (unsigned i = 0; i < count; ++i) mesh.positions.push_back(to_vec3(source.mVertices[i]));
  if (source.HasNormals()) {
    mesh.normals.reserve(count);
    for (unsigned i = 0; i < count; ++i) mesh.normals.push_back(to_vec3(source.mNormals[i]));
  }
  if (!source.HasTextureCoords(uv_channel)) uv_channel = 0;
  if (source.HasTextureCoords(uv_channel)) {
    mesh.uvs.reserve(count);
    for (unsigned i = 0; i < count; ++i) {
      mesh.uvs.emplace_back(source.mTextureCoords[uv_channel][i].x, source.mTextureCoords[uv_channel][i].y);
    }
  }
  if (source.HasVertexColors(0)) {
    mesh.colors.reserve(count);
    for (unsigned i = 0; i < count; ++i) {
      mesh.colors.push_back(import_color(source.mColors[0][i], gltf));
    }
  }
}

/// The file's own tangents; a normal map was made for exactly these.
void import_tangents(const aiMesh& source, Mesh& mesh) {
  mesh.tangents.reserve(source.mNumVertices);
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const glm::vec3 tangent = to_vec3(source.mTangents[i]);
    const float length = glm::length(tangent);
    const float side = glm::dot(glm::cross(mesh.normals[i], tangent), to_vec3(source.mBitangents[i]));
    mesh.tangents.emplace_back(length > 0.0f && std::isfinite(length) ? tangent / length : glm::vec3(1.0f, 0.0f, 0.0f),
                               side < 0.0f ? -1.0f : 1.0f);
  }
}

void import_morph_targets(const aiMesh& source, Mesh& mesh) {
  for (unsigned t = 0; t < source.mNumAnimMeshes; ++t) {
    const aiAnimMesh& animated = *source.mAnimMeshes[t];
    if (!animated.mVertices || animated.mNumVertices != source.mNumVertices) continue;
    MorphTarget target;
    target.name = animated.mName.C_Str();
    target.weight = std::isfinite(animated.mWeight) ? animated.mWeight : 0.0f;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      target.position_offsets.push_back(to_vec3(animated.mVertices[i] - source.mVertices[i]));
    }
    if (animated.mNormals && source.HasNormals()) {
      for (unsigned i = 0; i < source.mNumVertices; ++i) {
        target.normal_offsets.push_back(to_vec3(animated.mNormals[i] - source.mNormals[i]));
      }
    }
    mesh.morph_targets.push_back(std::move(target));
  }
}

void add_influence(glm::u16vec4& joints, glm::vec4& weights, uint16_t joint, float weight) {
  int weakest = 0;
  for (int k = 1; k < 4; ++k) {
    if (weights[k] < weights[weakest]) weakest = k;
  }
  if (weight <= weights[weakest]) return;
  joints[weakest] = joint;
  weights[weakest] = weight;
}

void import_skin(Import& import, const aiMesh& source, Mesh& mesh) {
  Skin skin;
  skin.vertex_joints.assign(source.mNumVertices, glm::u16vec4(0));
  skin.vertex_weights.assign(source.mNumVertices, glm::vec4(0.0f));
  for (unsigned b = 0; b < source.mNumBones; ++b) {
    const aiBone& bone = *source.mBones[b];
    const auto node = import.node_of_name.find(bone.mName.C_Str());
    if (node == import.node_of_name.end() || skin.joints.size() > 65535) {
      ++import.repairs.joints_without_node;
      continue;
    }
    const auto joint = static_cast<uint16_t>(skin.joints.size());
    skin.joints.push_back({node->second, to_dmat4(bone.mOffsetMatrix, import.repairs)});
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
      const unsigned vertex = bone.mWeights[w].mVertexId;
      const float weight = bone.mWeights[w].mWeight;
      if (vertex >= source.mNumVertices) {
        throw InputError("{}: mesh '{}', joint '{}': vertex index {} is out of range, there are {}",
                         import.path.string(), source.mName.C_Str(), bone.mName.C_Str(), vertex, source.mNumVertices);
      }
      if (std::isfinite(weight)) {
        add_influence(skin.vertex_joints[vertex], skin.vertex_weights[vertex], joint, weight);
      }
    }
  }
  for (glm::vec4& weights : skin.vertex_weights) {
    const float sum = weights.x + weights.y + weights.z + weights.w;
    weights = sum > 0.0f ? weights / sum : glm::vec4(0.0f);
  }
  if (!skin.joints.empty()) mesh.skin = std::move(skin);
}

}  // namespace

Mesh import_mesh(Import& import, const aiMesh& source) {
  Mesh mesh;
  mesh.name = source.mName.C_Str();
  import_triangles(import, source, mesh);
  if (mesh.triangles.empty() || !source.HasPositions()) return Mesh();

  mesh.material = import_material(import, source.mMaterialIndex);
  Material& material = import.scene.materials[mesh.material];
  import_vertices(source, import.uv_channel[mesh.material], import.gltf, mesh);
  import_morph_targets(source, mesh);
  if (source.HasBones()) import_skin(import, source, mesh);
  if (source.HasNormals() && source.HasTangentsAndBitangents() && !mesh.uvs.empty()) {
    import_tangents(source, mesh);
  }
  import.repairs.non_finite_triangles += drop_non_finite(mesh);

  if (!mesh.normals.empty()) {
    normalize_normals(mesh);
    weld_vertices(mesh);
  } else if (mesh.skin || !mesh.morph_targets.empty()) {
    weld_vertices(mesh);
    generate_smooth_normals(mesh);
  } else {
    generate_normals(mesh, crease);
  }
  if (material.normal_texture >= 0 && mesh.tangents.empty()) generate_tangents(mesh);
  return mesh;
}

}  // namespace omma::file
