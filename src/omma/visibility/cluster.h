// Up to sixteen triangles of a mesh, one SIMD register.
#pragma once

#include <cstdint>
#include <vector>

#include "omma/scene/scene.h"
#include "omma/visibility/box.h"

namespace omma {

struct alignas(64) Cluster {
  static constexpr uint32_t size = 16;
  static constexpr uint32_t unused = 0xffffffffu;

  float corner[3][3][size];  ///< [corner][axis][triangle], in the mesh's own frame; unused triangles are zero
  uint32_t triangle[size];   ///< its number in the mesh, or `unused`

  /// Left as it is: where millions are made, filling them is what takes time.
  Cluster() {}

  /// Takes the corners over from the mesh and returns the box around them. A triangle with a corner that is not finite
  /// becomes a point, which no ray meets.
  Box fill(const Mesh& mesh);
};

/// Triangles that lie beside each other: what a cluster is filled with.
struct TriangleGroup {
  uint32_t triangle[Cluster::size];  ///< numbers in the mesh, then `Cluster::unused`
  Box box;                           ///< around them, in the mesh's own frame
};

/// All of the mesh's triangles but those that have a corner that is not finite. Runs on all cores.
std::vector<TriangleGroup> group_triangles(const Mesh& mesh);

}  // namespace omma
