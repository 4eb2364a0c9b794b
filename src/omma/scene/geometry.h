// What is computed from a mesh's triangles: shared vertices, normals, tangents.
#pragma once

#include "omma/scene/scene.h"

namespace omma {

/// Drops triangles with a vertex at NaN or infinity and returns how many. Other attributes that are not finite become
/// zero.
size_t drop_non_finite(Mesh& mesh);

/// Makes vertices with equal attributes (bit by bit) one and removes those that no triangle uses. Triangles keep their
/// order.
void weld_vertices(Mesh& mesh);

/// Normals weighted by corner angle, over faces that meet at less than `crease` radians; vertices at creases are
/// doubled. Needs a mesh without skin and morph targets.
void generate_normals(Mesh& mesh, float crease);

/// Normals weighted by corner angle over all triangles of a vertex; leaves the vertices as they are.
void generate_smooth_normals(Mesh& mesh);

/// Unit length; a normal without direction becomes that of its triangle.
void normalize_normals(Mesh& mesh);

/// From uvs, orthogonal to the normals. Does nothing without uvs.
void generate_tangents(Mesh& mesh);

}  // namespace omma
