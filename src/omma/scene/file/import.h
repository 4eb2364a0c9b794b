// The parts of reading a scene file through assimp. Each quirk of a format is dealt with, and told, where it bites.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "omma/base/limits.h"
#include "omma/scene/file/reach.h"
#include "omma/scene/scene.h"

namespace omma::file {

/// What was left out or repaired; said in one warning at the end.
struct Repairs {
  size_t points_and_lines = 0;
  size_t non_finite_triangles = 0;
  size_t non_finite_transforms = 0;
  size_t second_uv_sets = 0;
  size_t height_maps = 0;
  size_t opacity_maps = 0;
  size_t joints_without_node = 0;
  size_t channels_without_node = 0;
};

/// A file being turned into a scene.
struct Import {
  Import(std::filesystem::path file, const aiScene& read, const ReadOptions& options)
      : path(std::move(file)), reach(path, options.root), limits(options.limits), source(read) {}

  std::filesystem::path path;
  Reach reach;
  Limits limits;
  const aiScene& source;
  /// glTF declares what the other formats leave open: sidedness, alpha, linear colours, light units.
  bool gltf = false;
  Scene scene;
  Repairs repairs;

  std::unordered_map<std::string, int> node_of_name;  ///< the first of each name
  std::map<unsigned, int> material_of_source;
  std::vector<unsigned> uv_channel;  ///< of each of scene.materials
  std::map<std::string, int> texture_of_key;
  std::map<std::string, int> texture_of_picture;  ///< the first of each file or embedded picture; -1: none can be used
  size_t texels = 0;                              ///< of scene.textures
};

inline glm::vec3 to_vec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }
inline glm::dvec3 to_dvec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }
inline glm::vec3 to_vec3(const aiColor3D& c) { return {c.r, c.g, c.b}; }
inline glm::dquat to_dquat(const aiQuaternion& q) { return {q.w, q.x, q.y, q.z}; }
/// assimp's matrices are stored by rows. Counts and replaces one that is not finite.
glm::dmat4 to_dmat4(const aiMatrix4x4& matrix, Repairs& repairs);

/// The mesh with whatever of it can be drawn; no triangles when nothing can.
Mesh import_mesh(Import& import, const aiMesh& source);

/// Index into scene.materials; only materials that a mesh uses are read.
int import_material(Import& import, unsigned source_index);

/// Index into scene.textures. A picture that is missing, broken, out of reach or beyond the limits becomes a checker of
/// magenta and black.
int import_texture(Import& import, const std::string& name, bool srgb, Texture::Wrap wrap_u, Texture::Wrap wrap_v);

void import_lights_and_cameras(Import& import);

void import_animations(Import& import);

}  // namespace omma::file
