// How much of a surface is there: alpha of a material at a point of a triangle, looked up on the CPU.
#pragma once

#include <cstdint>

#include "omma/scene/scene.h"

namespace omma {

/// A blended surface is solid where it covers at least this much, a half: in labels, distances and shadows, which
/// cannot be blended. A little less, because glass of just a half is common and interpolation loses some of it here and
/// there.
inline constexpr float label_alpha_cutoff = 0.4999f;

/// The least coverage that stops a ray, of a masked material or a blended one.
inline float coverage_cutoff(const Material& material) {
  return material.alpha == Material::Alpha::blend ? label_alpha_cutoff : material.alpha_cutoff;
}

/// Base colour's alpha times the vertices' times the texture's finest level, bilinear; 0 to 1. `u` and `v` are the
/// barycentric weights of the triangle's second and third corner.
float coverage(const Scene& scene, const Mesh& mesh, uint32_t triangle, float u, float v);

}  // namespace omma
