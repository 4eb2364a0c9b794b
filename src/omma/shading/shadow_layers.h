// Which maps the lights of a scene need to cast shadows: a map is what a camera in the light's place sees.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/scene/lights.h"
#include "omma/scene/scene.h"

namespace omma {

/// Whether lights cast shadows, and which maps of what they see say so.
enum class Shadows {
  off,
  paraboloid,  ///< one or two paraboloids a light
  cube,        ///< up to six faces of a cube
};
/// off, paraboloid, cube. Throws CommandError with the nearest name when there is no such kind.
Shadows shadows_from_name(const std::string& name);

/// One map of a light: what it sees of one side of the world.
struct ShadowLayer {
  int light;  ///< of the scene's lights
  /// `perspective`, or `stereographic` (a paraboloid). Along its edges it sees a few texels more than its share of the
  /// directions, so that a filter finds all it reads within one map.
  Camera camera;
  glm::dmat4 worldFromMap;  ///< rigid, looks along -Z
  bool flat() const;        ///< perspective
};

/// Square maps of `size` texels, a light's one after another. Points have two paraboloids or six faces of a cube;
/// spots one map of their cone, or, where it is too wide for one, those sides that it reaches. A sun is one map of
/// those `boxes` that anything lies behind, seen from so far away that no ray is farther off than the sun's own radius,
/// 0.27 degrees. The boxes (world) hold the scene's triangles. Throws MachineError for more than 2^15 texels a
/// side or 2^31 in all.
std::vector<ShadowLayer> plan_shadow_layers(std::span<const Light> lights, std::span<const Bounds> boxes, Shadows kind,
                                            int size);

/// A map as shaders see it: four vectors, as in shaders/shading/shadow.glsl.
struct ShadowMapRecord {
  glm::vec4 mapFromCamera[3];  ///< rows: right, down, ahead
  glm::vec4 lens;              ///< focal length and centre in texels; 1 for flat maps; `near`
};

/// The records of all layers, in their order, for a camera; the lights learn which maps are theirs. `near`: metres,
/// which the maps hold by their distances (flat ones: by how far ahead) as quotients.
std::vector<ShadowMapRecord> shadow_map_records(std::span<const ShadowLayer> layers, const glm::dmat4& worldFromCamera,
                                                float near, std::span<LightRecord> lights);

/// Boxes that hold the scene's triangles: of each instance, or of its single triangles where it reaches to the scene's
/// end, as the ground does.
std::vector<Bounds> boxes_of_triangles(const Scene& scene);

}  // namespace omma
