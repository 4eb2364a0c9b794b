// A scene as a grid of cells that are free or hold surface: coarse, but made and asked in little time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "omma/scene/scene.h"

namespace omma {

class OccupancyGrid {
 public:
  /// What lies within the bounds, which must not be empty. Cells are as long as wide, and lower where the scene is
  /// flat.
  OccupancyGrid(const Scene& scene, const Bounds& bounds);

  glm::ivec3 size() const { return size_; }
  glm::dvec3 cell() const { return cell_; }  ///< metres
  glm::dvec3 center(const glm::ivec3& at) const { return origin_ + (glm::dvec3(at) + 0.5) * cell_; }
  glm::ivec3 at(const glm::dvec3& point) const { return glm::ivec3(glm::floor((point - origin_) / cell_)); }
  bool contains(const glm::ivec3& at) const {
    return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < size_.x && at.y < size_.y && at.z < size_.z;
  }

  /// No surface; outside the grid there is none.
  bool is_free(const glm::ivec3& at) const { return !contains(at) || sides_[index(at)] == 0; }
  /// Holds surface whose front is seen from above.
  bool is_floor(const glm::ivec3& at) const { return contains(at) && (sides_[index(at)] & side(1, true)) != 0; }

  struct Sight {
    double distance;  ///< metres to the first surface, or to where the ray leaves the grid
    bool meets;       ///< it meets a surface
    bool front;       ///< whose front it sees
  };
  /// From a point within the grid; the cell that it is in does not count. The direction is of unit length.
  Sight look(const glm::dvec3& from, const glm::dvec3& direction) const;

 private:
  /// A bit for each direction of an axis that surfaces of a cell face.
  static uint8_t side(int axis, bool positive) { return uint8_t(1 << (2 * axis + (positive ? 1 : 0))); }
  size_t index(const glm::ivec3& at) const { return (size_t(at.z) * size_.y + at.y) * size_.x + at.x; }
  /// Corners in cells.
  void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

  glm::dvec3 origin_{0.0}, cell_{1.0};
  glm::ivec3 size_{1};
  std::vector<uint8_t> sides_;
};

}  // namespace omma
