// Which pixels of a block triangles may meet: many triangles smaller than a pixel fall between the rays. Included once
// for every SIMD target, by Highway's rules.
#if defined(OMMA_VISIBILITY_PIXEL_BOUNDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_PIXEL_BOUNDS_INL_H_
#undef OMMA_VISIBILITY_PIXEL_BOUNDS_INL_H_
#else
#define OMMA_VISIBILITY_PIXEL_BOUNDS_INL_H_
#endif

#include "omma/visibility/ray_tree.h"
#include "omma/visibility/simd16-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// The first and the last column and row of sixteen triangles.
struct alignas(64) PixelBounds {
  float column[2][16], row[2][16];

  /// Those that the bounds of triangle `t` touch.
  uint32_t leaves(int t) const {
    const uint32_t columns =
        (2u << int(column[1][t]) / RayBlock::leaf_side) - (1u << int(column[0][t]) / RayBlock::leaf_side);
    const uint32_t first = uint32_t(row[0][t]) & ~3u, end = (uint32_t(row[1][t]) & ~3u) + 4;
    return columns * 0x1111u & ((1u << end) - (1u << first));
  }

  /// Returns those triangles that a ray may meet. `slant` is the inverse of the volume that the edges from a corner and
  /// the way to it span, all of unit length: the less that is, the farther rounding may move the edges' planes.
  HWY_INLINE Mask find(const PixelGrid& grid, const Vectors* vertex, const Floats& largest_square,
                       const Floats& slant) {
    const Vectors axis = all(grid.axis.x, grid.axis.y, grid.axis.z);
    const Floats ahead[3] = {dot(vertex[0], axis), dot(vertex[1], axis), dot(vertex[2], axis)};
    const Floats least_ahead = min(min(ahead[0], ahead[1]), ahead[2]);
    // Only of triangles well in front, of which no corner is much farther than another: there, this bounds the
    // rounding.
    const Mask clear =
        (least_ahead > all(0.0f)) & (least_ahead * least_ahead >= largest_square * all(0.0625f)) & (slant <= all(1e4f));
    const Floats inverse[3] = {all(1.0f) / ahead[0], all(1.0f) / ahead[1], all(1.0f) / ahead[2]};
    const Floats moved = mul_add(slant, all(4e-6f), all(4e-6f));
    return along(grid.column, grid.column_error, vertex, inverse, moved, clear, column) &
           along(grid.row, grid.row_error, vertex, inverse, moved, clear, row);
  }

 private:
  static HWY_INLINE Mask along(const glm::vec3& axis, float error, const Vectors* vertex, const Floats* inverse,
                               const Floats& moved, const Mask& clear, float (*bounds)[16]) {
    const Vectors pixels = all(axis.x, axis.y, axis.z);
    const Floats place[3] = {dot(vertex[0], pixels) * inverse[0], dot(vertex[1], pixels) * inverse[1],
                             dot(vertex[2], pixels) * inverse[2]};
    const Floats room = mul_add(moved, all(glm::length(axis)), all(error));
    const Floats zero = all(0.0f), end = all(float(RayBlock::side - 1));
    const Floats first = choose(clear, max(ceil(min(min(place[0], place[1]), place[2]) - room), zero), zero);
    const Floats last = choose(clear, min(floor(max(max(place[0], place[1]), place[2]) + room), end), end);
    store(first, bounds[0]);
    store(last, bounds[1]);
    return first <= last;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
