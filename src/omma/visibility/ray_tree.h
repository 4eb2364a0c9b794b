// The rays of an image as a tree, kept in memory: blocks of 16 x 16 pixels, leaves of 4 x 4, and for each the cone that
// encloses its rays.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/visibility/ray_source.h"

namespace omma {

/// The first pixels of the squares that cover an image, neighbours near to each other.
std::vector<glm::ivec2> squares_of(ImageSize size);

class RayTree final : public RaySource {
 public:
  RayTree() = default;
  /// Directions of unit length, or zero for no ray. Rays begin at the camera's centre, or, as those of omnidirectional
  /// stereo, each at its own of `origins`: metres in the camera frame, as many as directions. Neighbours that begin
  /// near each other are found soonest. Throws CommandError for origins that are not as many or not finite. Runs on all
  /// cores.
  explicit RayTree(const RayMap& rays, std::span<const glm::vec3> origins = {});
  /// Everything that the source has, which has no origins. Runs on all cores.
  explicit RayTree(const RaySource& source);

  ImageSize size() const override { return size_; }
  int samples() const override { return samples_; }
  size_t squares() const override { return borders_.size(); }
  RaySquares some(size_t first, size_t count, RayRoom& room) const override;
  /// Those of the squares in which there is a ray, neighbours near to each other.
  const std::vector<RayBlock>& blocks() const { return blocks_; }
  /// By squares: around the first sample's rays.
  const std::vector<SquareBorder>& borders() const { return borders_; }
  /// The first pixels of the squares in which there is none.
  const std::vector<glm::ivec2>& blank() const { return blank_; }
  /// By the blocks; empty where all rays begin at the camera's centre.
  const std::vector<BlockOrigins>& origins() const { return origins_; }
  size_t bytes() const {
    return blocks_.size() * sizeof(RayBlock) + borders_.size() * sizeof(SquareBorder) +
           origins_.size() * sizeof(BlockOrigins);
  }

 private:
  void keep(std::span<const char> filled);

  ImageSize size_;
  int samples_ = 1;
  std::vector<RayBlock> blocks_;
  std::vector<SquareBorder> borders_;
  std::vector<glm::ivec2> blank_;
  std::vector<BlockOrigins> origins_;
};

}  // namespace omma
