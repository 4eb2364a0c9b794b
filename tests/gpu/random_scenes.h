// Scenes and poses by a seed, for tests of whatever finds triangles.
#pragma once

#include <glm/glm.hpp>
#include <random>

#include "omma/scene/scene.h"

namespace omma {

/// Triangles all around the origin, of all sizes, some of them double-sided, in three instances of two meshes.
Scene random_soup(int triangles, unsigned seed, float unit = 1.0f);

/// A ball of triangles that is dented at random: from its middle every ray meets exactly one.
Scene dented_ball(unsigned seed, const Material& material);

/// Anywhere in a scene's bounds, looking anywhere.
glm::dmat4 pose_within(const Bounds& bounds, std::mt19937& random);
glm::dmat4 pose_at(const glm::dvec3& place, double yaw, double pitch);

}  // namespace omma
