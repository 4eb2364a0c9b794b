// From a path to a scene: reading, the tree of nodes, what the file's units are, what is said at the end.
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cctype>
#include <cmath>
#include <string_view>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/scene/file/bounded_io.h"
#include "omma/scene/file/import.h"
#include "omma/scene/file/json_depth.h"

namespace omma::file {

glm::dmat4 to_dmat4(const aiMatrix4x4& matrix, Repairs& repairs) {
  glm::dmat4 result(1.0);
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      const double value = matrix[row][column];
      if (!std::isfinite(value)) {
        ++repairs.non_finite_transforms;
        return glm::dmat4(1.0);
      }
      result[static_cast<int>(column)][static_cast<int>(row)] = value;
    }
  }
  return result;
}

namespace {

/// assimp's glTF reader drops faces whose indices are out of range and says so in its log alone.
class IndexComplaints : public Assimp::LogStream {
 public:
  IndexComplaints() : own_logger_(Assimp::DefaultLogger::isNullLogger()) {
    if (own_logger_) Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(this, Assimp::Logger::Warn);
  }
  ~IndexComplaints() override {
    Assimp::DefaultLogger::get()->detachStream(this, Assimp::Logger::Warn);
    if (own_logger_) Assimp::DefaultLogger::kill();
  }
  void write(const char* message) override {
    heard_ = heard_ || std::string_view(message).find("out-of-range indices") != std::string_view::npos;
  }
  bool heard() const { return heard_; }

 private:
  bool own_logger_;
  bool heard_ = false;
};

/// Factors into translation, rotation, scale; keeps the matrix where that loses something (shear, a scale of zero).
void set_transform(Node& node, const glm::dmat4& parentFromNode) {
  node.translation = glm::dvec3(parentFromNode[3]);
  glm::dmat3 axes(parentFromNode);
  for (int i = 0; i < 3; ++i) node.scale[i] = glm::length(axes[i]);
  if (glm::determinant(axes) < 0.0) node.scale.x = -node.scale.x;
  if (node.scale.x * node.scale.y * node.scale.z == 0.0) {
    node.matrix = parentFromNode;
    return;
  }
  for (int i = 0; i < 3; ++i) axes[i] /= node.scale[i];
  node.rotation = glm::normalize(glm::quat_cast(axes));
  const glm::dmat3 again = glm::mat3_cast(node.rotation);
  double error = 0.0;
  for (int i = 0; i < 3; ++i) error = std::max(error, glm::length(again[i] - axes[i]));
  // Files hold single precision; beyond its rounding it is shear.
  if (error > 1e-5 || parentFromNode[0][3] != 0.0 || parentFromNode[1][3] != 0.0 || parentFromNode[2][3] != 0.0) {
    node.matrix = parentFromNode;
  }
}

/// Metres a unit of the file. Collada's unit is in assimp's root transform already; FBX says how many centimetres
/// its unit has, and assimp leaves that to the reader. The others know no units: theirs are taken for metres.
double metres_per_unit(const aiScene& source, bool fbx) {
  if (!fbx || !source.mMetaData) return 1.0;
  double centimetres = 1.0;
  float single = 1.0f;
  if (!source.mMetaData->Get("UnitScaleFactor", centimetres) && source.mMetaData->Get("UnitScaleFactor", single)) {
    centimetres = single;
  }
  return std::isfinite(centimetres) && centimetres > 0.0 ? 0.01 * centimetres : 0.01;
}

struct Placement {
  unsigned mesh;
  int node;
};

/// The tree with parents before children, and which of the file's meshes stand where.
std::vector<Placement> import_nodes(Import& import, double scale) {
  std::vector<Placement> placements;
  std::vector<std::pair<const aiNode*, int>> open = {{import.source.mRootNode, -1}};
  while (!open.empty()) {
    const auto [source, parent] = open.back();
    open.pop_back();
    const int index = static_cast<int>(import.scene.nodes.size());
    Node node;
    node.name = source->mName.C_Str();
    node.parent = parent;
    glm::dmat4 parentFromNode = to_dmat4(source->mTransformation, import.repairs);
    if (parent < 0 && scale != 1.0) {
      parentFromNode = glm::dmat4(glm::dmat3(scale)) * parentFromNode;  // the root stands for the file's unit
    }
    set_transform(node, parentFromNode);
    import.node_of_name.emplace(node.name, index);
    import.scene.nodes.push_back(std::move(node));
    for (unsigned i = 0; i < source->mNumMeshes; ++i) {
      placements.push_back({source->mMeshes[i], index});
    }
    for (unsigned i = source->mNumChildren; i-- > 0;) open.push_back({source->mChildren[i], index});
  }
  return placements;
}

/// Adds to a sum that has a limit; throws InputError beyond it, so that nothing is made that will be refused.
void add(const Import& import, size_t& sum, size_t more, size_t Limits::*limit, const char* what) {
  sum += more;
  if (sum > import.limits.*limit) {
    throw InputError("{}: {} {} at least: {}", import.path.string(), sum, what, limit_text(import.limits, limit));
  }
}

void import_instances(Import& import, const std::vector<Placement>& placements) {
  Scene& scene = import.scene;
  std::map<unsigned, int> mesh_of_source;
  size_t triangles = 0, vertices = 0, instances = 0;
  add(import, instances, placements.size(), &Limits::scene_instances, "meshes placed by nodes");
  int object = -1, object_node = -1;
  for (const Placement& placement : placements) {
    if (placement.mesh >= import.source.mNumMeshes) {
      throw InputError("{}: node '{}' refers to mesh {} of {}", import.path.string(), scene.nodes[placement.node].name,
                       placement.mesh, import.source.mNumMeshes);
    }
    const aiMesh& source = *import.source.mMeshes[placement.mesh];
    const auto add_vertices = [&] {
      add(import, vertices, size_t{source.mNumVertices} * (size_t{source.mNumAnimMeshes} + 1), &Limits::scene_vertices,
          "vertices of meshes and their morph targets");
    };
    auto [entry, fresh] = mesh_of_source.try_emplace(placement.mesh, static_cast<int>(scene.meshes.size()));
    if (fresh) {
      add_vertices();
      Mesh mesh = import_mesh(import, source);
      if (mesh.triangles.empty()) {
        entry->second = -1;
      } else {
        scene.meshes.push_back(std::move(mesh));
      }
    }
    if (entry->second < 0) continue;
    int mesh = entry->second;
    if (!fresh && source.mNumAnimMeshes > 0) {
      // Two nodes may morph one mesh differently, so each has its own.
      add_vertices();
      scene.meshes.push_back(Mesh(scene.meshes[mesh]));
      mesh = static_cast<int>(scene.meshes.size()) - 1;
    }
    if (placement.node != object_node) {
      object_node = placement.node;
      ++object;
    }
    Instance instance;
    instance.mesh = mesh;
    instance.node = placement.node;
    instance.object = object;
    scene.instances.push_back(instance);
    add(import, triangles, scene.meshes[mesh].triangles.size(), &Limits::scene_triangles,
        "triangles over all instances");
  }
}

/// Throws InputError for meshes that nothing can be done with safely.
void require_sound(const aiScene& source, const std::filesystem::path& path) {
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    const aiMesh& mesh = *source.mMeshes[m];
    if (mesh.mMaterialIndex >= source.mNumMaterials) {
      throw InputError("{}: mesh '{}' refers to material {} of {}", path.string(), mesh.mName.C_Str(),
                       mesh.mMaterialIndex, source.mNumMaterials);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < mesh.mNumVertices) continue;
        throw InputError("{}: mesh '{}', face {}: vertex index {} is out of range, there are {} vertices",
                         path.string(), mesh.mName.C_Str(), f, face.mIndices[k], mesh.mNumVertices);
      }
    }
  }
}

void require_triangles(const Import& import) {
  if (!import.scene.instances.empty()) return;
  size_t faces = 0;
  for (unsigned i = 0; i < import.source.mNumMeshes; ++i) {
    faces += import.source.mMeshes[i]->mNumFaces;
  }
  throw InputError(
      "{}: no triangle to draw; found {} meshes with {} faces ({} points and lines, {} triangles "
      "with a vertex at NaN or infinity) and {} nodes",
      import.path.string(), import.source.mNumMeshes, faces, import.repairs.points_and_lines,
      import.repairs.non_finite_triangles, import.scene.nodes.size());
}

void report(const Import& import) {
  const Repairs& repairs = import.repairs;
  std::string message;
  const auto say = [&](size_t count, const char* what) {
    if (count > 0) message += fmt::format("{}{} {}", message.empty() ? "" : "; ", count, what);
  };
  say(repairs.non_finite_triangles, "triangles with a vertex at NaN or infinity dropped");
  say(repairs.points_and_lines, "points and lines left out, only triangles are drawn");
  say(repairs.non_finite_transforms, "transforms with NaN or infinity ignored");
  say(repairs.second_uv_sets, "textures drawn with the uvs of their material's first texture");
  say(repairs.height_maps, "height maps left out, only normal maps are drawn");
  say(repairs.opacity_maps, "opacity maps left out, only the base colour's own alpha cuts out");
  say(repairs.joints_without_node, "joints without a node ignored");
  say(repairs.channels_without_node, "animated nodes that do not exist ignored");
  if (!message.empty()) warn(import.path.string() + ": " + message);
}

void set_default_view(Scene& scene) {
  const Bounds bounds = scene.bounds();
  const double diagonal = glm::length(bounds.extent());
  scene.default_to = bounds.center();
  scene.default_from =
      scene.default_to + glm::normalize(glm::dvec3(0.6, 0.4, 1.0)) * (diagonal > 0.0 ? 1.3 * diagonal : 1.0);
  scene.default_is_guess = true;
}

void require_scene_file(const Assimp::Importer& importer, const std::filesystem::path& path,
                        const std::string& extension) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw InputError("scene file '{}' does not exist", path.string());
  }
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw InputError("scene file '{}' is a folder or device, not a file", path.string());
  }
  if (std::filesystem::file_size(path, ignored) == 0) {
    throw InputError("scene file '{}' is empty", path.string());
  }
  if (!importer.IsExtensionSupported(extension)) {
    throw InputError(
        "scene file '{}': format '{}' is unknown; among those known are .gltf, .glb, .obj, .ply, "
        ".stl, .dae and .fbx",
        path.string(), extension);
  }
}

}  // namespace
}  // namespace omma::file

namespace omma {

Scene load_scene_file(const std::filesystem::path& path, const ReadOptions& options) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  Assimp::Importer importer;
  auto* const files = new file::BoundedFiles(path.string(), file::Reach(path, options.root), options.limits);
  importer.SetIOHandler(files);  // the importer owns it
  file::require_scene_file(importer, path, extension);
  require_readable(path, options.limits);
  const bool gltf = extension == ".gltf" || extension == ".glb" || extension == ".vrm";
  if (gltf) file::require_shallow_json(path, options.limits);
  // Checked between reading and processing: assimp trusts what its readers made of a file, and its own validation
  // refuses harmless things, an STL solid without faces for one.
  file::IndexComplaints complaints;
  const aiScene* source = importer.ReadFile(path.string(), 0);
  if (complaints.heard()) {
    throw InputError("scene file '{}' has vertex indices out of range: faces refer to vertices that do not exist",
                     path.string());
  }
  if (source && source->mRootNode) {
    file::require_sound(*source, path);
    // Normals, tangents and shared vertices are made in geometry.h: assimp's versions sort vertices by position, which
    // NaN derails. FlipUVs: assimp's v = 0 is the bottom row in every format.
    source = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_FlipUVs | aiProcess_TransformUVCoords);
  }
  if (!source || !source->mRootNode) {
    std::string why = importer.GetErrorString();
    if (why.empty()) why = "it holds no scene";
    for (const std::string& refusal : files->refusals()) why += "; " + refusal;
    throw InputError("scene file '{}' cannot be read as {}: {}", path.string(), extension.substr(1), why);
  }
  for (const std::string& refusal : files->refusals()) {
    warn(fmt::format("{}: a file that it names is not read: {}", path.string(), refusal));
  }
  file::Import import(path, *source, options);
  import.gltf = gltf;
  import.scene.name = path.filename().string();
  const auto placements = file::import_nodes(import, file::metres_per_unit(*source, extension == ".fbx"));
  file::import_instances(import, placements);
  file::require_triangles(import);
  file::import_lights_and_cameras(import);
  file::import_animations(import);
  finish_scene(import.scene);
  file::set_default_view(import.scene);
  file::report(import);
  return std::move(import.scene);
}

}  // namespace omma
