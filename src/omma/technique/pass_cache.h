// What is derived from a pass's rays and kept: rays take longer to compute than to follow, and a sequence asks for the
// same ones again and again.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "omma/technique/view.h"

namespace omma {

/// One T for each shift of a tile of a camera.
template <typename T>
class PassCache {
 public:
  /// `make(camera, tile, shift)` returns a T.
  template <typename Make>
  const T& get(const View& view, const Make& make) {
    if (camera_ != view.camera || tile_ != view.tile || by_shift_.size() >= kept) {
      by_shift_.clear();
      camera_ = view.camera;
      tile_ = view.tile;
    }
    const std::pair shift(view.shift.x, view.shift.y);
    const auto found = by_shift_.find(shift);
    if (found != by_shift_.end()) return found->second;
    return by_shift_.emplace(shift, make(view.camera, view.tile, view.shift)).first->second;
  }

  template <typename Each>
  void each(const Each& visit) const {
    for (const auto& [shift, value] : by_shift_) visit(value);
  }

 private:
  static constexpr size_t kept = 16;
  std::optional<Camera> camera_;
  PixelRect tile_;
  std::map<std::pair<double, double>, T> by_shift_;
};

}  // namespace omma
