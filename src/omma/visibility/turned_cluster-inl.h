// The triangles of a cluster as a block of rays sees them. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_VISIBILITY_TURNED_CLUSTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_TURNED_CLUSTER_INL_H_
#undef OMMA_VISIBILITY_TURNED_CLUSTER_INL_H_
#else
#define OMMA_VISIBILITY_TURNED_CLUSTER_INL_H_
#endif

#include <bit>
#include <type_traits>
#include <variant>

#include "omma/visibility/box_in_cone-inl.h"
#include "omma/visibility/pixel_bounds-inl.h"
#include "omma/visibility/ray_tree.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// A triangle whose plane passes this near to the centre, against what its edges and distance would allow, has no
/// reliable plane: on which side the camera is, and how far the plane, is rounding.
constexpr float edge_on = 1e-5f;

/// `origins` is null where rays have none.
template <bool has_origins>
HWY_INLINE Apex apex_of(const PlacedBody& body, const BlockOrigins* origins) {
  if constexpr (!has_origins) return {body.origin, body.pad};
  return {body.origin - origins->apex * body.scale, body.pad + origins->radius * body.scale};
}

/// What rays with origins of their own ask for beside that. A ray from o along d sees an edge from p to q by n · d +
/// (q - p) · (o x d).
struct alignas(64) TurnedForOrigins {
  float span[3][3][16];    ///< [edge][axis][triangle]: q - p, turned and scaled as the planes are
  float edge_room[3][16];  ///< what that may add at most
  float nearer[16];        ///< how many times nearer than from the apex a triangle may be
};

/// The triangles of a cluster, relative to the camera: planes through the centre and each edge, turned so that rays
/// inside have no negative product, and the plane of inverse distance. [vector][axis][triangle]
template <bool has_origins>
struct alignas(64) TurnedCluster {
  float edge[3][3][16], edge_length[3][16];
  float depth[3][16], depth_length[16];
  float corner[3][3][16];
  uint32_t by_weights = 0;  ///< triangles whose distance comes from their corners: they are seen edge-on
  std::conditional_t<has_origins, TurnedForOrigins, std::monostate> apart;
  PixelBounds pixels;

  /// Returns the triangles that the block may see: from the part's front, or, where both sides are seen, from where the
  /// camera is.
  /// Inlined by force, here and below: with two kinds of rays compilers would call it, which costs a fifth of the time.
  HWY_INLINE uint32_t turn(const RayBlock& block, const BlockOrigins* origins, float farthest, const PlacedBody& body,
                           const PlacedPart& part, const Cluster& cluster) {
    const float front = part.front;
    const Vectors column[3] = {all(body.columns[0].x, body.columns[0].y, body.columns[0].z),
                               all(body.columns[1].x, body.columns[1].y, body.columns[1].z),
                               all(body.columns[2].x, body.columns[2].y, body.columns[2].z)};
    const glm::vec3 from = apex_of<has_origins>(body, origins).origin;
    const Vectors origin = all(from.x, from.y, from.z);
    Vectors vertex[3];
    for (int i = 0; i < 3; ++i) {
      vertex[i] = transform(column, origin,
                            {load(cluster.corner[i][0]), load(cluster.corner[i][1]), load(cluster.corner[i][2])});
    }
    const Floats square[3] = {dot(vertex[0], vertex[0]), dot(vertex[1], vertex[1]), dot(vertex[2], vertex[2])};
    // From its nearest corner, whose products lose least.
    const Mask before = square[0] < square[1], last = square[2] < min(square[0], square[1]);
    const Vectors nearest = choose(last, vertex[2], choose(before, vertex[0], vertex[1]));
    const Vectors ab = choose(last, vertex[0], choose(before, vertex[1], vertex[2])) - nearest;
    const Vectors ac = choose(last, vertex[1], choose(before, vertex[2], vertex[0])) - nearest;
    const Vectors normal = cross(ab, ac);
    const Floats volume = dot(normal, nearest);
    // The squares of what rounding may make of the volume.
    const Floats spread = dot(ab, ab) * dot(ac, ac) * dot(nearest, nearest);
    const Floats zero = all(0.0f);
    Mask unsure = volume * volume <= spread * all(edge_on * edge_on);
    const float radius = has_origins ? origins->radius * body.scale : 0.0f;
    // Twice the radius: where the apex is nearer to the plane, distances from beside it would lose digits.
    if constexpr (has_origins) unsure = unsure | (volume * volume <= dot(normal, normal) * all(4.1f * radius * radius));
    const Floats side = front == 0.0f ? volume : all(front);
    Mask kept = abs(normal.x) + abs(normal.y) + abs(normal.z) > zero;
    if (front != 0.0f) kept = kept & ((volume * side > zero) | unsure);

    if constexpr (!has_origins) {
      const Floats slant = sqrt(spread) / abs(volume);
      kept = kept & pixels.find(block.grid, vertex, max(max(square[0], square[1]), square[2]), slant);
      if (bits(kept) == 0) return 0;
    }

    const Cone& cone = block.cone;
    const Vectors axis = all(cone.axis.x, cone.axis.y, cone.axis.z);
    for (int i = 0; i < 3; ++i) {
      // The product of both corners, without its loss of digits where they are close to each other, or one of them is
      // far away; the same to the bit, turned round, for the triangle on the other side.
      const Vectors& p = vertex[(i + 1) % 3];
      const Vectors& q = vertex[(i + 2) % 3];
      const Floats p_square = square[(i + 1) % 3], q_square = square[(i + 2) % 3];
      const Vectors near = choose(p_square < q_square, p, choose(q_square < p_square, q, (p + q) * all(0.5f)));
      const Vectors plane = with_sign(cross(near, q - p), side);
      const Floats length = length_or_more(plane);
      Floats most = dot(plane, axis);
      if constexpr (has_origins) {
        const Vectors span = with_sign(q - p, side) * all(body.scale);
        const Floats room = length_or_more(span) * all(origins->radius);
        most = most + room;
        store(span.x, apart.span[i][0]);
        store(span.y, apart.span[i][1]);
        store(span.z, apart.span[i][2]);
        store(room, apart.edge_room[i]);
      }
      if (front != 0.0f)
        kept = kept & (most >= length * all(-cone.sin));
      else
        kept = kept & ((most >= length * all(-cone.sin)) | unsure);
      store(plane.x, edge[i][0]);
      store(plane.y, edge[i][1]);
      store(plane.z, edge[i][2]);
      store(length, edge_length[i]);
    }
    // Per metre only now: squares of metres need not fit.
    const Vectors scaled_depth = normal * (all(1.0f) / volume);
    const Floats steepness = length_or_more(scaled_depth) * all(body.scale);
    const Vectors inverse_distance = scaled_depth * all(body.scale);
    Floats most = mul_add(steepness, all(cone.sin), abs(dot(inverse_distance, axis)));
    if constexpr (has_origins) {
      const Floats nearer = all(1.0f) / (all(1.0f) - steepness * all(origins->radius));
      store(nearer, apart.nearer);
      most = most * nearer;
    }
    kept = kept & ((most * all(1.0f + slack) >= all(farthest)) | unsure);
    store(inverse_distance.x, depth[0]);
    store(inverse_distance.y, depth[1]);
    store(inverse_distance.z, depth[2]);
    store(steepness, depth_length);
    by_weights = bits(unsure);
    const uint32_t triangles = bits(kept);
    if ((triangles & by_weights) != 0 || part.alpha != Material::Alpha::opaque) {
      for (int i = 0; i < 3; ++i) {
        store(vertex[i].x, corner[i][0]);
        store(vertex[i].y, corner[i][1]);
        store(vertex[i].z, corner[i][2]);
      }
    }
    return triangles;
  }

  static HWY_INLINE Vectors with_sign(const Vectors& v, const Floats& sign) {
    return {times_sign(v.x, sign), times_sign(v.y, sign), times_sign(v.z, sign)};
  }

  void turn_round(uint32_t triangles) {
    for (; triangles != 0; triangles &= triangles - 1) {
      const int t = std::countr_zero(triangles);
      for (int i = 0; i < 3; ++i) {
        for (auto& axis : edge[i]) axis[t] = -axis[t];
        if constexpr (has_origins) {
          for (auto& axis : apart.span[i]) axis[t] = -axis[t];
        }
      }
    }
  }

  /// A ray through an edge belongs to the side whose plane's first number that is not zero is positive.
  bool owns(int of_edge, int t) const {
    for (const auto& axis : edge[of_edge]) {
      if (axis[t] != 0.0f) return axis[t] > 0.0f;
    }
    return true;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
