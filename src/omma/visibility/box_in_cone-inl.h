// Boxes against cones, sixteen at a time. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_VISIBILITY_BOX_IN_CONE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_BOX_IN_CONE_INL_H_
#undef OMMA_VISIBILITY_BOX_IN_CONE_INL_H_
#else
#define OMMA_VISIBILITY_BOX_IN_CONE_INL_H_
#endif

#include "omma/visibility/placed_scene.h"
#include "omma/visibility/simd16-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// What bounds are widened by, relatively: more than single precision takes off a few products.
constexpr float slack = 1e-5f;
/// What an approximate inverse square root may be off by, relatively, on any target; and what it may be taken of.
constexpr float rough = 3e-3f;
constexpr float smallest_square = 1e-36f;

/// A body as a cone's apex sees it.
struct Apex {
  glm::vec3 origin;  ///< of the body, scaled, from the apex
  float pad;  ///< what its points may be beside their place, scaled: rounding, and how far rays begin from the apex
};

HWY_INLINE Floats length_or_more(const Vectors& v) {
  const Floats square = max(dot(v, v), all(smallest_square));
  return square * rough_inverse_sqrt(square) * all(1.0f + rough);
}

HWY_INLINE Vectors transform(const Vectors* column, const Vectors& origin, const Vectors& p) {
  return {mul_add(column[0].x, p.x, mul_add(column[1].x, p.y, mul_add(column[2].x, p.z, origin.x))),
          mul_add(column[0].y, p.x, mul_add(column[1].y, p.y, mul_add(column[2].y, p.z, origin.y))),
          mul_add(column[0].z, p.x, mul_add(column[1].z, p.y, mul_add(column[2].z, p.z, origin.z)))};
}

/// Boxes against cones, of which one side is the same sixteen times: false where no ray of the cone meets the box.
/// `near` becomes what every point of the box that is in the cone is away at least.
///
/// The plane that touches the cone on the side of the box's centre parts the two if the whole box is beyond it.
HWY_INLINE Mask may_meet(const Vectors& centre, const Vectors& half, const Vectors& axis, const Floats& sin,
                         const Floats& cos, const PlacedBody& placed, const Apex& apex, Floats& near) {
  const Vectors column[3] = {all(placed.columns[0].x, placed.columns[0].y, placed.columns[0].z),
                             all(placed.columns[1].x, placed.columns[1].y, placed.columns[1].z),
                             all(placed.columns[2].x, placed.columns[2].y, placed.columns[2].z)};
  const Vectors origin = all(apex.origin.x, apex.origin.y, apex.origin.z);
  const Vectors c = transform(column, origin, centre);
  const Floats along = dot(c, axis);
  const Vectors across = c - axis * along;
  const Floats square = dot(across, across);
  // Too small by a little, which tilts the plane away from the cone.
  const Floats inverse_height = rough_inverse_sqrt(max(square, all(smallest_square))) * all(1.0f - rough);
  const Floats height = square * inverse_height;
  const Vectors outwards = across * (cos * inverse_height) - axis * sin;
  const Floats beyond = height * cos - along * sin;
  const Floats reach = mul_add(half.x, abs(dot(column[0], outwards)),
                               mul_add(half.y, abs(dot(column[1], outwards)), half.z * abs(dot(column[2], outwards))));
  const Floats depth = mul_add(half.x, abs(dot(column[0], axis)),
                               mul_add(half.y, abs(dot(column[1], axis)), half.z * abs(dot(column[2], axis))));
  const Floats room = mul_add(all(1e-6f), height + abs(along), all(apex.pad));
  near = (along - depth - room) * all(1.0f / placed.scale);
  return beyond <= reach + room;
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
