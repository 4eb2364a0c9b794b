// Drawing the scene's triangles with the rasterizer: culling, grouping by material, blending in order. Techniques say
// with which stages, and where things land.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "omma/gl/program.h"
#include "omma/technique/technique.h"

namespace omma {

struct MeshPass {
  std::vector<gl::Stage> stages;  ///< all but the fragment shader
  gl::Defines defines;
  std::function<void(const gl::Program&)> set_uniforms;  ///< called once for each program
  std::function<bool(const Bounds& world)> may_be_seen;  ///< whole parts that answer false are left out
  bool mirror_image = false;                             ///< the picture turns windings round
  bool culls = true;  ///< false: triangles that face away were left out before the rasterizer
  const char* fragment_shader = "technique/mesh.frag";
};

/// Depth test, counters and blending of surfaces, for as long as it lives. The scene's vertices are bound.
class SurfaceState {
 public:
  SurfaceState(DrawTools& tools, bool blends);
  ~SurfaceState();
  SurfaceState(const SurfaceState&) = delete;
  SurfaceState& operator=(const SurfaceState&) = delete;

 private:
  DrawTools& tools_;
};

/// Makes ready to draw surfaces of a material, and returns the program that will.
const gl::Program& use_material(DrawTools& tools, const MeshPass& pass, const View& view, int material, bool mirrored);

struct BlendedTriangle {
  double distance2;  ///< of its centroid from the camera, square metres
  size_t part;
  uint32_t number;  ///< in its part
};

/// The triangles of blended materials, the farthest first.
std::vector<BlendedTriangle> blended_triangles(const GpuScene& scene,
                                               const std::function<bool(const Bounds& world)>& may_be_seen);

class MeshDrawer {
 public:
  explicit MeshDrawer(DrawTools& tools) : tools_(tools) {}

  /// Draws into the bound framebuffer: opaque and masked materials first, then, for colour, blended ones from back to
  /// front by their triangles' centroids.
  void draw(const MeshPass& pass, const View& view);
  /// Its two halves. Of labels all surfaces are solid.
  void draw_solid(const MeshPass& pass, const View& view);
  void draw_blended(const MeshPass& pass, const View& view);

 private:
  DrawTools& tools_;
};

/// False when a box lies wholly beyond one side of the clip volume (its near and far planes apart).
bool may_be_in_frustum(const glm::dmat4& clipFromWorld, const Bounds& world);

}  // namespace omma
