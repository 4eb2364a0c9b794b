// What each light sees first, without OpenGL: the maps of shading/shadow_layers.h, found by rays.
#pragma once

#include <vector>

#include "omma/shading/shadow_layers.h"
#include "omma/visibility/finder.h"
#include "omma/visibility/recent_rays.h"

namespace omma {

class ShadowDepths {
 public:
  /// What the maps' depths are a multiple of, metres.
  static constexpr float near = 1.0f;

  /// Finds the maps of all lights that are not there, of `size` texels along a side. Leaves the finder with a light's
  /// view. Throws MachineError for maps that take too much memory. Runs on all cores.
  void use(const Scene& scene, Shadows kind, int size, Finder& finder, RecentRays& rays);
  /// Lights or what they shine on have moved.
  void scene_changed() { kind_ = Shadows::off; }

  const std::vector<ShadowLayer>& layers() const { return layers_; }
  /// Layer by layer, rows from the top: near / distance, for flat maps / how far ahead; 0 where nothing is.
  const std::vector<float>& depths() const { return depths_; }
  int size() const { return size_; }

 private:
  std::vector<ShadowLayer> layers_;
  std::vector<float> depths_;
  Shadows kind_ = Shadows::off;
  int size_ = 0;
};

}  // namespace omma
