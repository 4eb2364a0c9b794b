// The rays of a camera's image, made where they are used: nothing of a ray is kept, so that a camera may change with
// every frame, and memory does not grow with the samples.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "omma/camera/ray_patch.h"
#include "omma/visibility/ray_source.h"

namespace omma {

/// A camera's patches by the squares of a region of its image.
class SquarePatches {
 public:
  /// Runs on all cores.
  SquarePatches(const Camera& camera, const PixelRect& region);
  SquarePatches(const SquarePatches&) = delete;
  SquarePatches& operator=(const SquarePatches&) = delete;

  const Camera& camera() const { return camera_; }
  const PixelRect& region() const { return region_; }

  struct Square {
    glm::ivec2 first;                 ///< pixel of the region
    int patch = exact;                ///< a place in patches(), or
    static constexpr int exact = -1;  ///< its rays are the formula's own, one by one
  };
  /// Those in which there may be a ray, neighbours near to each other.
  const std::vector<Square>& squares() const { return squares_; }
  const std::vector<RayPatch>& patches() const { return patches_; }
  /// True only where the point of the image has no ray.
  bool is_blank(const glm::dvec2& pixel) const { return fitter_.is_blank(pixel, 0.0); }
  size_t bytes() const { return squares_.capacity() * sizeof(Square) + patches_.capacity() * sizeof(RayPatch); }

 private:
  Camera camera_;
  PatchFitter fitter_;
  PixelRect region_;
  std::vector<Square> squares_;
  std::vector<RayPatch> patches_;
};

class CameraRays final : public RaySource {
 public:
  /// The rays `shifts` from the centres of the pixels of `region`, at most half a pixel; the region lies within the
  /// image.
  CameraRays(const Camera& camera, const PixelRect& region, std::vector<glm::dvec2> shifts)
      : CameraRays(std::make_shared<const SquarePatches>(camera, region), std::move(shifts)) {}
  CameraRays(std::shared_ptr<const SquarePatches> patches, std::vector<glm::dvec2> shifts)
      : patches_(std::move(patches)), shifts_(std::move(shifts)) {}

  ImageSize size() const override { return {patches_->region().width(), patches_->region().height()}; }
  int samples() const override { return int(shifts_.size()); }
  size_t squares() const override { return patches_->squares().size(); }
  RaySquares some(size_t first, size_t count, RayRoom& room) const override;

 private:
  /// Ray by ray.
  void make_exactly(const glm::ivec2& first, std::span<RayBlock> blocks, SquareBorder& border) const;
  template <typename Form>
  void make_of(const Form& form, const glm::ivec2& first, std::span<RayBlock> blocks, SquareBorder& border) const;

  std::shared_ptr<const SquarePatches> patches_;
  std::vector<glm::dvec2> shifts_;
};

}  // namespace omma
