// A scene: meshes of one material each, instances of them under a tree of nodes, materials, textures, lights, cameras
// and animation. Knows nothing of cameras' lenses or of the GPU.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "omma/base/limits.h"
#include "omma/math/bounds.h"
#include "omma/scene/changes.h"

namespace omma {

/// 8-bit RGBA texels, rows from the top (texture coordinate v = 0 is the top row, as in glTF).
struct Texture {
  enum class Wrap { repeat, clamp, mirror };
  std::string name;
  int width = 0;
  int height = 0;
  bool srgb = true;  ///< colour is stored in sRGB; normals and metallic-roughness are linear
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  std::vector<glm::u8vec4> texels;
};

struct Material {
  enum class Alpha { opaque, mask, blend };
  std::string name;
  glm::vec4 base_color{1.0f};  ///< linear; multiplied with texture and vertex colour
  glm::vec3 emissive{0.0f};    ///< linear
  float metallic = 0.0f;
  float roughness = 0.8f;
  float normal_scale = 1.0f;
  Alpha alpha = Alpha::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;
  /// Indices into Scene::textures, -1 for none.
  int base_color_texture = -1;
  int normal_texture = -1;
  int metallic_roughness_texture = -1;  ///< G roughness, B metallic, as in glTF
  int emissive_texture = -1;
};

/// Up to four joints move a vertex.
struct Skin {
  struct Joint {
    int node = -1;
    glm::dmat4 jointFromMesh{1.0};  ///< inverse bind matrix
  };
  std::vector<Joint> joints;
  std::vector<glm::u16vec4> vertex_joints;  ///< one per vertex
  std::vector<glm::vec4> vertex_weights;    ///< one per vertex, sum 1 or 0 (a vertex that nothing moves)
};

struct MorphTarget {
  std::string name;
  std::vector<glm::vec3> position_offsets;  ///< one per vertex
  std::vector<glm::vec3> normal_offsets;    ///< one per vertex, or empty
  float weight = 0.0f;                      ///< when no animation sets it
};

/// Triangles of one material. All per-vertex arrays have the same length; `tangents`, `uvs` and `colors` may be empty.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;  ///< metres, in the mesh's own frame; in the world's when it has a skin
  std::vector<glm::vec3> normals;    ///< unit length
  std::vector<glm::vec4> tangents;   ///< w is the bitangent's sign
  std::vector<glm::vec2> uvs;
  std::vector<glm::u8vec4> colors;  ///< linear, 255 = 1
  std::vector<glm::uvec3> triangles;
  int material = 0;

  std::optional<Skin> skin;
  std::vector<MorphTarget> morph_targets;
  /// Positions and normals before skin and morph targets; empty for a mesh that never deforms.
  std::vector<glm::vec3> rest_positions;
  std::vector<glm::vec3> rest_normals;
  std::vector<glm::vec4> rest_tangents;  ///< empty when `tangents` is
  bool deforms() const { return !rest_positions.empty(); }

  Bounds bounds() const;
};

struct Node {
  std::string name;
  int parent = -1;  ///< index of a node before this one, or -1
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  /// Takes the place of the three above where a file's matrix has shear.
  std::optional<glm::dmat4> matrix;
  glm::dmat4 worldFromNode{1.0};  ///< of the scene's current time
};

/// A mesh at a node. Instances of one node share an object number. A skinned mesh stands where its joints are: its
/// worldFromObject is the identity.
struct Instance {
  int mesh = 0;
  int node = 0;  ///< -1: it stands where it was put, whatever the time
  int object = 0;
  uint32_t first_triangle = 0;  ///< the id of its first triangle; ids count on through all instances
  /// Which one it is, whatever its place in the list: no other instance of the scene has it, or had it before.
  uint32_t key = 0;
  glm::dmat4 worldFromObject{1.0};
};

/// A light with a node sits at that node's origin and shines along its -Z.
struct Light {
  enum class Kind { sun, point, spot };
  Kind kind = Kind::sun;
  std::string name;
  int node = -1;                         ///< it moves with this node, or -1
  glm::dvec3 position{0.0};              ///< world metres, of the current time; not for suns
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< world, the way the light travels; not for points
  glm::vec3 color{1.0f};          ///< linear; suns: irradiance; points and spots: radiant intensity (over distance²)
  float range = 0.0f;             ///< metres beyond which it gives no light; 0: no limit
  float inner_angle = 0.0f;       ///< spot, radians from its axis: full light inside
  float outer_angle = 0.785398f;  ///< spot, radians from its axis: no light outside
};

/// A camera that a file brings along: only its pose, that of its node without scale; the lens is the user's choice.
struct SceneCamera {
  std::string name;
  int node = -1;
  glm::dmat4 worldFromCamera{1.0};  ///< of the current time, rigid
};

/// Keys are sorted by time; values between them are interpolated (rotations spherically), outside them held.
template <typename T>
struct Keys {
  std::vector<double> times;  ///< seconds
  std::vector<T> values;
  bool step = false;  ///< hold each value instead
};

struct NodeAnimation {
  int node = 0;
  Keys<glm::dvec3> translation;
  Keys<glm::dquat> rotation;
  Keys<glm::dvec3> scale;
};

struct MorphAnimation {
  int node = 0;  ///< the node whose meshes deform
  Keys<std::vector<float>> weights;
};

struct Animation {
  std::string name;
  double duration = 0.0;  ///< seconds
  std::vector<NodeAnimation> nodes;
  std::vector<MorphAnimation> morphs;
};

struct Scene {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Light> lights;  ///< empty: a default sun
  glm::vec3 ambient{0.25f};   ///< linear radiance from everywhere
  std::vector<SceneCamera> cameras;
  std::vector<Animation> animations;
  uint32_t next_key = 0;  ///< of the next instance that is added

  /// A place to stand when neither the user nor the file names one.
  glm::dvec3 default_from{0.0, 0.0, 5.0};
  glm::dvec3 default_to{0.0};
  /// Nobody chose it: a file's is in front of the centre of its bounds, to the right and above, 1.3 times their
  /// diagonal away. omma/viewpoint has better, for a camera.
  bool default_is_guess = false;

  size_t triangle_count() const;  ///< over all instances
  Bounds bounds() const;          ///< world, over all instances
};

/// For whoever builds a scene by hand: numbers the instances and, through all of them, the triangles, keeps the rest
/// pose of meshes that deform, and moves everything to time 0. Objects are the caller's to number.
void finish_scene(Scene& scene);

/// Counts the triangles' ids through all instances: after instances were added or removed.
void number_triangles(Scene& scene);

/// Moves nodes, instances, lights and cameras to `seconds` of the scene's animation (by default its first; names from
/// Scene::animations) and deforms skinned and morphed meshes. The time wraps around at the animation's end. A scene
/// without animation ignores the time. Throws CommandError when there is no animation of that name or the time is not
/// finite. Returns what has changed.
SceneChanges set_time(Scene& scene, double seconds, std::string_view animation = {});

/// The scene of a text: a built-in (`city`, `city:blocks=54,seed=1`; see `builtin_scenes()`) or a file that assimp
/// reads. A text with an extension or a `/` is a file.
/// Throws CommandError for a name or parameter, InputError for a file; warns of what it repaired.
Scene load_scene(std::string_view text, const ReadOptions& options = {});

/// glTF and GLB, OBJ, PLY, STL, Collada, FBX and whatever else assimp knows. Throws InputError for a file without a
/// triangle that can be drawn, and for one beyond the limits or that needs a file out of reach; warns, once a file, of
/// triangles and textures that cannot be drawn.
Scene load_scene_file(const std::filesystem::path& path, const ReadOptions& options = {});

/// A whole number.
struct BuiltinParameter {
  const char* name;
  double default_value, min, max;
  const char* description;
};

struct BuiltinScene {
  const char* name;
  const char* description;
  std::vector<BuiltinParameter> parameters;
  Scene (*make)(const std::vector<double>& values);  ///< one value per parameter, in order
};

const std::vector<BuiltinScene>& builtin_scenes();

}  // namespace omma
