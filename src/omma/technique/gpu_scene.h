// A scene on the GPU: packed vertices, instances relative to the camera, lights, materials.
//
// Everything is drawn in the camera frame: transforms are multiplied in double precision and only then rounded, so a
// scene may lie a million metres from the world's origin, and a triangle's vertices are already relative to the centre
// of projection, as homogeneous rasterization wants them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/gl/context.h"
#include "omma/gl/objects.h"
#include "omma/scene/scene.h"
#include "omma/shading/shadow_layers.h"
#include "omma/technique/materials.h"

namespace omma {

/// At most part_triangles consecutive triangles of one instance: the unit of culling and of drawing.
struct Part {
  int instance = 0;
  int material = 0;
  bool mirrored = false;     ///< the transform turns the winding round
  uint32_t first_index = 0;  ///< into the index buffer
  uint32_t index_count = 0;
  uint32_t first_triangle = 0;  ///< id of its first triangle
  Bounds bounds;                ///< world
};

inline constexpr uint32_t part_triangles = 1024;

/// The maps that say which light reaches what.
struct ShadowTable {
  std::vector<ShadowLayer> layers;  ///< a light's one after another
  gl::Texture maps;                 ///< depths, a layer each
};

/// What one object is surrounded by: two stereographic maps around its middle, along the world's -Z and +Z.
struct ReflectionTable {
  int object = 0;
  gl::Texture maps;
  float focal = 1.0f, size = 1.0f;  ///< texels
  float last_level = 0.0f;
};

class GpuScene {
 public:
  GpuScene(const Scene& scene, const gl::Context& context);

  /// Follows the scene, which has changed so. Vertices are uploaded only of meshes that are others; of all meshes when
  /// one of them has other triangles.
  void update(const SceneChanges& changes);
  /// Makes everything relative to a camera's pose. `background`: linear RGB, nothing for a sky.
  void set_view(const glm::dmat4& worldFromCamera, const std::optional<glm::vec3>& background);
  /// Lights cast shadows by these maps from the next set_view on; null: none does. The table must outlive its use.
  void set_shadows(const ShadowTable* shadows) { shadows_ = shadows; }
  bool has_shadows() const { return shadows_ != nullptr; }
  /// From the next set_view on an object shows what surrounds it; null: none does. The table must outlive its use.
  void set_reflection(const ReflectionTable* reflection) { reflection_ = reflection; }
  /// True where surfaces of a material may belong to the object that reflects.
  bool reflects(int material) const;
  /// From the next set_view on rasterizing techniques leave an object out.
  void set_hidden(std::optional<int> object) { hidden_ = object; }
  bool hides() const { return hidden_.has_value(); }
  /// Binds uniform block 0, instances and lights as buffer textures (units 14, 15), shadow and reflection maps (26,
  /// 27).
  void bind() const;
  /// Binds the vertices as buffer textures for whoever fetches them by number (units 5, 6, 7, 9).
  void bind_vertex_textures() const;

  const Scene& scene() const { return *scene_; }
  const std::vector<Part>& parts() const { return parts_; }
  const Materials& materials() const { return materials_; }
  const gl::VertexArray& vertex_array() const { return vertex_array_; }
  const gl::Buffer& indices() const { return indices_; }
  /// Of a mesh, in the common vertex buffers.
  uint32_t first_vertex(size_t mesh) const { return first_vertex_[mesh]; }
  /// Of a mesh, in the common index buffer, in triangles.
  uint32_t first_triangle(size_t mesh) const { return first_index_[mesh] / 3; }
  const glm::dmat4& worldFromCamera() const { return worldFromCamera_; }
  bool has_blending() const { return has_blending_; }
  size_t bytes() const;

 private:
  void upload_meshes();
  void upload_vertices(size_t mesh);
  void measure(size_t mesh);
  void list_parts();
  void place_parts();
  void make_vertex_array();

  const Scene* scene_;
  const gl::Context* context_;
  Materials materials_;
  std::vector<std::vector<Bounds>> bounds_;  ///< by mesh, of its parts, in its own frame
  std::vector<Part> parts_;
  std::vector<uint32_t> first_vertex_, first_index_;  ///< per mesh, in the common buffers
  gl::Buffer positions_, attributes_, colors_, indices_, part_records_, instances_, frame_;
  gl::Texels light_texels_{GL_RGBA32F};
  const ShadowTable* shadows_ = nullptr;
  const ReflectionTable* reflection_ = nullptr;
  std::optional<int> hidden_;
  gl::Texture position_texels_, attribute_texels_, color_texels_, triangle_texels_, instance_texels_;
  gl::VertexArray vertex_array_;
  glm::dmat4 worldFromCamera_{1.0};
  bool has_blending_ = false;
};

}  // namespace omma
