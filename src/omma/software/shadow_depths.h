// What each light sees first, without OpenGL: the maps of shading/shadow_layers.h, found by rays.
#pragma once

#include <vector>

#include "omma/shading/shadow_layers.h"
#include "omma/visibility/finder.h"
#include "omma/visibility/recent_rays.h"

namespace omma {

/// Of all lights at once; of a scene that has not changed since.
class ShadowDepths {
 public:
  /// What the maps' depths are a multiple of, metres.
  static constexpr float near = 1.0f;

  /// Finds the maps, of `size` texels along a side. Throws MachineError for maps that take too much memory. Runs on
  /// all cores.
  ShadowDepths(const SceneIndex& index, Shadows kind, int size, RecentRays& rays);

  const std::vector<ShadowLayer>& layers() const { return layers_; }
  /// Layer by layer, rows from the top: near / distance, for flat maps / how far ahead; 0 where nothing is.
  const std::vector<float>& depths() const { return depths_; }
  int size() const { return size_; }

 private:
  int size_;
  std::vector<ShadowLayer> layers_;
  std::vector<float> depths_;
};

}  // namespace omma
