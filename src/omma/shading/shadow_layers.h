// Which maps the lights of a scene need to cast shadows: a map is what a camera in the light's place sees.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "omma/camera/camera.h"
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
/// 0.27 degrees. The boxes (world) hold the scene's triangles.
std::vector<ShadowLayer> plan_shadow_layers(std::span<const Light> lights, std::span<const Bounds> boxes, Shadows kind,
                                            int size);

/// Boxes that hold the scene's triangles: of each instance, or of its single triangles where it reaches to the scene's
/// end, as the ground does.
std::vector<Bounds> boxes_of_triangles(const Scene& scene);

}  // namespace omma
