// Changes of a scene that a host makes itself: its own vertices, instances that come and go, other materials and
// lights.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/scene/scene.h"

namespace omma {

/// Each change is made whole or, when it throws CommandError, not at all. Meshes, materials and textures are numbered
/// as in the scene; instances are named by their keys, which stay when others come and go.
class SceneEdit {
 public:
  /// Of a scene that finish_scene, or one of the loaders, has finished. What changes is added to `changes`. Both must
  /// outlive this object.
  SceneEdit(Scene& scene, SceneChanges& changes);

  const Scene& scene() const { return scene_; }

  /// As omma::set_time. Moves instances back to their nodes.
  void set_time(double seconds, std::string_view animation = {});

  /// The transform is finite. An instance of a mesh with a skin moves by its joints alone and is refused.
  void move(uint32_t instance, const glm::dmat4& worldFromObject);
  /// Another instance of a mesh that has neither skin nor morph targets, with the object number that the channel
  /// `object` shows, 0 or more. Returns its key. Its triangles' ids come after all others; set_time leaves it where it
  /// is.
  uint32_t add_instance(int mesh, const glm::dmat4& worldFromObject, int object);
  /// The triangles of later instances move up: their ids are lower from now on.
  void remove_instance(uint32_t instance);

  /// Other vertices, as many as the mesh has, in its frame: metres, and normals of unit length, or none to keep those
  /// that it has. All finite. They are copied.
  /// Refused for meshes with a skin or morph targets, which set_time moves.
  void set_vertices(int mesh, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals = {});
  /// A mesh of the scene from now on, without skin and morph targets; no instance shows it yet. Returns its number.
  int add_mesh(Mesh mesh);
  /// Other triangles, vertices and material for all its instances; again without skin and morph targets.
  void replace_mesh(int mesh, Mesh with);

  /// Return the new one's number.
  int add_texture(Texture texture);
  int add_material(const Material& material);
  void set_material(int material, const Material& with);

  /// All lights; without any there is a default sun. Those with a node stand where it is after the next set_time.
  void set_lights(std::vector<Light> lights);
  /// Linear radiance from everywhere.
  void set_ambient(const glm::vec3& ambient);

 private:
  Instance& find(uint32_t instance);
  Mesh& find_mesh(int mesh);
  void check(const Mesh& mesh) const;
  void check(const Material& material) const;

  Scene& scene_;
  SceneChanges& changes_;
};

}  // namespace omma
