// What is derived from a pass's rays and kept: a sequence asks for the same ones again and again.
#pragma once

#include "omma/base/recent_cache.h"
#include "omma/technique/view.h"

namespace omma {

struct PassKey {
  Camera camera;
  PixelRect tile;
  glm::dvec2 shift;

  friend bool operator==(const PassKey&, const PassKey&) = default;
};

/// One T for each shift of a tile of a camera.
template <typename T>
class PassCache {
 public:
  /// `make(camera, tile, shift)` returns a T.
  template <typename Make>
  const T& get(const View& view, const glm::dvec2& shift, const Make& make) {
    return cache_.get({view.camera, view.tile, shift},
                      [&](const PassKey& key) { return make(key.camera, key.tile, key.shift); });
  }

  template <typename Each>
  void each(const Each& visit) const {
    cache_.each(visit);
  }

 private:
  RecentCache<PassKey, T> cache_;
};

}  // namespace omma
