// Fragments shaded by the files of shaders/shading, compiled for every SIMD target.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "omma/scene/lights.h"
#include "omma/scene/scene.h"
#include "omma/shading/effects.h"
#include "omma/shading/shadow_layers.h"
#include "omma/software/fragments.h"
#include "omma/software/mip_texture.h"
#include "omma/software/surroundings.h"

namespace omma {

/// A scene as a camera sees it, for shading.
struct ShadedScene {
  const Scene* scene = nullptr;
  glm::dmat4 worldFromCamera{1.0};
  std::vector<LightRecord> lights;
  std::span<const MipTexture> textures;   ///< by the scene's
  std::optional<glm::vec3> background{};  ///< linear; nothing: a sky
  bool anisotropic = true;
  std::span<const Effect> effects{};
  std::vector<ShadowMapRecord> shadow_maps{};  ///< as the lights count them
  const float* shadow_depths = nullptr;        ///< of ShadowDepths
  int shadow_size = 0;                         ///< texels along a map
  const Surroundings* surroundings = nullptr;  ///< of the object that reflects; null where none does
};

/// Writes the fragments' colours and coverage. `block` and `border`: the rays of the first sample of their square, and
/// around it, which tell how rays change from pixel to pixel. On one thread, by the best SIMD target of this processor.
void shade_fragments(const ShadedScene& scene, const RayBlock& block, const SquareBorder& border, Fragments& fragments);

}  // namespace omma
