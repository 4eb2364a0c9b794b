// What of a body lies in the pyramid that a block of rays looks along. Included once for every SIMD target, by
// Highway's rules.
#if defined(OMMA_VISIBILITY_BLOCK_SIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_BLOCK_SIGHT_INL_H_
#undef OMMA_VISIBILITY_BLOCK_SIGHT_INL_H_
#else
#define OMMA_VISIBILITY_BLOCK_SIGHT_INL_H_
#endif

#include <cmath>

#include "omma/visibility/box_in_cone-inl.h"
#include "omma/visibility/ray_tree.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// A block's pyramid, where its rays have one, and its axis, both in the frame of a body.
class BlockSight {
 public:
  /// From a block's `apex`.
  void look(const RayBlock& block, const PlacedBody& body, const Apex& apex) {
    block_ = &block;
    body_ = &body;
    apex_ = apex;
    const PixelGrid& grid = block.grid;
    has_pyramid_ = std::isfinite(grid.column_error) && std::isfinite(grid.row_error);
    if (!has_pyramid_) return;
    constexpr float last = RayBlock::side - 1;
    const float beside_column = grid.column_error + slack * glm::length(grid.column);
    const float beside_row = grid.row_error + slack * glm::length(grid.row);
    set(sides_[0], glm::normalize(grid.column + beside_column * grid.axis));
    set(sides_[1], glm::normalize((last + beside_column) * grid.axis - grid.column));
    set(sides_[2], glm::normalize(grid.row + beside_row * grid.axis));
    set(sides_[3], glm::normalize((last + beside_row) * grid.axis - grid.row));
    set(ahead_, block.cone.axis);
  }
  bool is_for(const PlacedBody& body) const { return body_ == &body; }
  void forget() { body_ = nullptr; }

  /// Boxes of which a ray may meet something. `near` becomes what every point of the box that is in sight is away at
  /// least.
  HWY_INLINE Mask may_meet(const Vectors& centre, const Vectors& half, Floats& near) const {
    if (!has_pyramid_) {
      const Cone& cone = block_->cone;
      return HWY_NAMESPACE::may_meet(centre, half, all(cone.axis.x, cone.axis.y, cone.axis.z), all(cone.sin),
                                     all(cone.cos), *body_, apex_, near);
    }
    near = (ahead_.along(centre) - ahead_.reach(half) - all(apex_.pad)) * all(1.0f / body_->scale);
    const Floats least = all(-apex_.pad);
    return (sides_[0].farthest(centre, half) >= least) & (sides_[1].farthest(centre, half) >= least) &
           (sides_[2].farthest(centre, half) >= least) & (sides_[3].farthest(centre, half) >= least);
  }

 private:
  /// A plane through the apex, turned towards what is in sight.
  struct Plane {
    float normal[3], offset;

    HWY_INLINE Floats along(const Vectors& p) const {
      return mul_add(all(normal[0]), p.x, mul_add(all(normal[1]), p.y, mul_add(all(normal[2]), p.z, all(offset))));
    }
    HWY_INLINE Floats reach(const Vectors& half) const {
      return mul_add(all(std::abs(normal[0])), half.x,
                     mul_add(all(std::abs(normal[1])), half.y, all(std::abs(normal[2])) * half.z));
    }
    HWY_INLINE Floats farthest(const Vectors& centre, const Vectors& half) const { return along(centre) + reach(half); }
  };

  void set(Plane& plane, const glm::vec3& normal) const {
    for (int i = 0; i < 3; ++i) plane.normal[i] = glm::dot(body_->columns[i], normal);
    plane.offset = glm::dot(apex_.origin, normal);
  }

  const RayBlock* block_ = nullptr;
  const PlacedBody* body_ = nullptr;
  Apex apex_{};
  bool has_pyramid_ = false;
  Plane sides_[4], ahead_;
};

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
