// Sorts what each pixel sees by triangle and by material: each visible triangle once, and for each material the squares
// of the image it is seen in.
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "omma/math/ray.h"
#include "omma/scene/scene.h"
#include "omma/visibility/ray_hit.h"

namespace omma {

/// Which triangle each pixel's ray meets first. Rows from the top.
struct VisibleTriangles {
  static constexpr uint32_t nothing = meets_nothing;
  /// As an instance: where there is no ray either.
  static constexpr uint32_t no_ray = omma::no_ray;

  ImageSize size;
  std::vector<glm::uvec2> hits;  ///< x: the triangle's id or `nothing`, y: its instance, `nothing` or `no_ray`
};

class VisibleSquares {
 public:
  static constexpr int side = 16;  ///< pixels
  /// In the place of a material: rays that meet nothing.
  static constexpr int background = -1;

  explicit VisibleSquares(const Scene& scene);

  /// Of what is sorted next, beside what the pixels see: it shall have a place in triangles() too. From any thread.
  void see(uint32_t triangle) { seen_[triangle].store(true, std::memory_order_relaxed); }
  /// `places` receives each pixel's place in triangles(), or VisibleTriangles::nothing. Runs on all cores; the result
  /// depends on the picture alone.
  void sort(const VisibleTriangles& visible, std::span<uint32_t> places);

  /// Each visible triangle once, by its id: x is that, y the instance.
  const std::vector<glm::uvec2>& triangles() const { return triangles_; }
  /// Of a triangle that is seen, in triangles().
  uint32_t place_of(uint32_t triangle) const { return place_[triangle]; }
  /// Of an instance; `background` of none.
  int material_of(uint32_t instance) const {
    return instance == VisibleTriangles::nothing ? background
                                                 : scene_.meshes[size_t(scene_.instances[instance].mesh)].material;
  }
  /// By material, in squares from the top left; the background where it is seen.
  const std::map<int, std::vector<glm::uvec2>>& squares() const { return squares_; }

 private:
  const Scene& scene_;
  std::vector<std::atomic<bool>> seen_;  ///< by triangle id
  std::vector<uint32_t> place_;          ///< by triangle id; of those that are seen
  std::vector<glm::uvec2> triangles_;
  std::map<int, std::vector<glm::uvec2>> squares_;
};

}  // namespace omma
