// What surrounds an object: two paraboloid maps from its middle, without itself, drawn before the picture and kept
// while the scene stays as it is.
#pragma once

#include <memory>

#include "omma/technique/shadow/shadow_maps.h"
#include "omma/technique/technique.h"

namespace omma {

class ReflectionMaps {
 public:
  /// `scene` is that of `tools`, which uses the shadow maps that the picture is to have.
  ReflectionMaps(DrawTools& tools, GpuScene& scene) : tools_(tools), scene_(scene) {}

  /// Hands the scene what options.reflect is surrounded by, which the next set_view takes over; draws it where it is
  /// not there. Leaves the scene with the maps' view. Throws CommandError when there is no such object, MachineError
  /// where the driver has no such maps.
  void use(const RenderOptions& options);
  /// The object or what surrounds it has moved.
  void scene_changed(const SceneChanges& changes);
  size_t bytes() const;

 private:
  /// What the maps depend on beside the scene.
  struct Key {
    int object, size;
    std::optional<glm::vec3> background;
    Shadows shadows;
    int shadow_size;
    friend bool operator==(const Key&, const Key&) = default;
  };
  void draw(const Key& key);

  DrawTools& tools_;
  GpuScene& scene_;
  std::unique_ptr<Technique> technique_;  ///< apart from the picture's
  Target target_;
  ReflectionTable table_;
  std::optional<Key> key_;  ///< of the maps that are there
};

}  // namespace omma
