// Scenes and poses by a seed, for tests of whatever finds triangles.
#pragma once

#include <glm/glm.hpp>

#include "omma/scene/scene.h"

namespace omma {

/// The environment variable OMMA_FULL_PROOF=1 asks for millions of cases where thousands do for every day.
bool full_proof();

/// Triangles all around the origin, of all sizes, some of them double-sided, in three instances of two meshes.
Scene random_soup(int triangles, unsigned seed, float unit = 1.0f);

/// A ball of triangles that is dented at random: from its middle every ray meets exactly one.
Scene dented_ball(unsigned seed, const Material& material);

glm::dmat4 pose_at(const glm::dvec3& place, double yaw, double pitch);

}  // namespace omma
