// What a ray meets, whoever looks for it.
#pragma once

#include <cstdint>

namespace omma {

/// In the place of a triangle, and of its instance.
inline constexpr uint32_t meets_nothing = 0xffffffffu;
/// In the place of an instance: there is no ray either.
inline constexpr uint32_t no_ray = 0xfffffffeu;

/// A triangle on a ray.
struct RayHit {
  uint32_t triangle;  ///< id over all instances
  uint32_t instance;
  float distance;  ///< metres, the ray's direction being of unit length
};

/// Which surfaces stop a ray.
enum class Solid {
  opaque,  ///< those that are not blended; the blended ones are passed
  labels,  ///< blended ones too, where they cover at least half
};

}  // namespace omma
