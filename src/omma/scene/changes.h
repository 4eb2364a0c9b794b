// What has changed in a scene since something was made of it, so that whatever was made follows without looking at all
// of the scene again.
#pragma once

#include <set>

namespace omma {

struct SceneChanges {
  bool moved = false;      ///< instances have other transforms
  bool lights = false;     ///< lights have moved, or there are others
  bool materials = false;  ///< materials look other than before, or there are more
  bool textures = false;   ///< there are more
  /// Instances were added or removed, or materials are of another kind: whoever knows parts of the scene by number or
  /// by kind lists them anew.
  bool listed = false;
  std::set<int> deformed{};  ///< meshes whose vertices are others, as many as before
  std::set<int> replaced{};  ///< meshes whose triangles are others, new meshes among them

  bool empty() const { return *this == SceneChanges{}; }
  /// What was made must follow triangles, not only materials and lights.
  bool of_shape() const { return moved || listed || !deformed.empty() || !replaced.empty(); }

  SceneChanges& operator+=(const SceneChanges& later) {
    moved |= later.moved;
    lights |= later.lights;
    materials |= later.materials;
    textures |= later.textures;
    listed |= later.listed;
    deformed.insert(later.deformed.begin(), later.deformed.end());
    replaced.insert(later.replaced.begin(), later.replaced.end());
    return *this;
  }
  friend bool operator==(const SceneChanges&, const SceneChanges&) = default;
};

}  // namespace omma
