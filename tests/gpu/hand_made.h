// Scenes by hand, small enough to know every number of.
#pragma once

#include <random>

#include "omma/scene/scene.h"

namespace omma {

/// Collects materials, meshes and placements; `finish` numbers them.
class SceneMaker {
 public:
  SceneMaker();
  int add(Material material);
  int add(Texture texture);
  int add(Mesh mesh);
  void add(Light light) { scene_.lights.push_back(light); }
  /// An object of its own; the number of its node.
  int place(int mesh, const glm::dmat4& worldFromObject = glm::dmat4(1.0));
  Scene& scene() { return scene_; }
  Scene finish();

 private:
  Scene scene_;
};

/// Two triangles a, b, c and a, c, d, counter-clockwise seen from the front; uv (0,0), (1,0), (1,1), (0,1).
Mesh make_quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, int material);

/// A square upright across the view at z, 2 * half on a side, facing +Z; its uv runs right and down.
Mesh make_pane(float z, float half, int material);

/// A coarse ball around the origin with smooth normals.
Mesh make_ball(float radius, int material);

/// Linear colour, no light needed.
Material unlit(const glm::vec4& color);

glm::dmat4 translation(const glm::dvec3& by);

/// A red ball, instance 0, before a green pane.
Scene make_ball_and_pane();
/// Moves the ball somewhere else in every frame, mirrored every other time: windings turn, and the order of the draws.
SceneChanges move_ball(Scene& scene, int frame, std::mt19937& random);

}  // namespace omma
