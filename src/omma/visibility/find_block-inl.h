// The finder for one block of rays: down the tree of boxes from front to back, triangles of a cluster against the
// block's leaves, a triangle against the sixteen rays of a leaf.
#if defined(OMMA_VISIBILITY_FIND_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_FIND_BLOCK_INL_H_
#undef OMMA_VISIBILITY_FIND_BLOCK_INL_H_
#else
#define OMMA_VISIBILITY_FIND_BLOCK_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <hwy/cache_control.h>

#include "omma/scene/coverage.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/simd16-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// What bounds are widened by, relatively: more than single precision takes off a few products.
constexpr float slack = 1e-5f;
/// A triangle whose plane passes this near to the centre, against what its edges and distance would allow, has no
/// reliable plane: on which side the camera is, and how far the plane, is rounding.
constexpr float edge_on = 1e-5f;

/// What an approximate inverse square root may be off by, relatively, on any target; and what it may be taken of.
constexpr float rough = 3e-3f;
constexpr float smallest_square = 1e-36f;

/// A child of a node that is still to be visited.
struct Pending {
  const BoxNode* node;
  const PlacedBody* body;  ///< the tree over bodies has a frame of its own
  uint32_t lane;
  float near;  ///< metres, at most what any of its points is away
};

/// The triangles of a cluster, relative to the camera: planes through the centre and each edge, turned so that rays
/// inside have no negative product, and the plane of inverse distance. [vector][axis][triangle]
struct alignas(64) TurnedTriangles {
  float edge[3][3][16], edge_length[3][16];
  float depth[3][16], depth_length[16];
  float corner[3][3][16];
  float near[16];           ///< of the plane of inverse distance: what it can be at most, in 1/metres
  uint32_t by_weights = 0;  ///< triangles whose distance comes from their corners: they are seen edge-on
};

class BlockFinder {
 public:
  explicit BlockFinder(const BlockQuery& query) : query_(query) {
    // Each node on the way down leaves at most its other children behind.
    pending_.resize(size_t(query.scene->depth() + 1) * BoxNode::width);
  }

  void find(const RayBlock& block, BlockPicture& picture, std::vector<BlockLayer>& layers) {
    block_ = &block;
    picture_ = &picture;
    layers_ = &layers;
    const BoxTree& top = query_.scene->top();
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      if (!query_.collect) clear(leaf);
      farthest_[leaf] = least(load(picture.inverse_distance[leaf]));
    }
    farthest_of_block_ = least(load(farthest_));
    if (top.nodes.empty()) return;
    count_ = 0;
    push_children(top.nodes[0], query_.scene->top_frame());
    while (count_ > 0) {
      const Pending next = pending_[--count_];
      if (next.near * farthest_of_block_ > 1.0f + slack) continue;
      const uint32_t child = next.node->child[next.lane];
      if (!(child & BoxNode::leaf)) {
        push_children(next.body->nodes[child], *next.body);
      } else if (next.body->clusters != nullptr) {
        visit_cluster(*next.node, next.lane, *next.body, next.body->parts[next.node->tag[next.lane]],
                      next.body->clusters[child & ~BoxNode::leaf]);
      } else {
        const PlacedBody& body = query_.scene->bodies()[child & ~BoxNode::leaf];
        if (is_asked_for(body)) push_children(body.nodes[0], body);
      }
    }
  }

 private:
  bool is_asked_for(const PlacedBody& body) const {
    return query_.collect ? body.blended : !body.blended || query_.solid == Solid::labels;
  }

  /// Nothing seen; rays that are none see the nearest thing there can be.
  void clear(int leaf) {
    const Mask rays = from_bits(block_->rays[leaf]);
    const float nearest = std::numeric_limits<float>::infinity();
    store(choose(rays, all(0.0f), all(nearest)), picture_->inverse_distance[leaf]);
    std::memset(picture_->triangle[leaf], 0xff, sizeof picture_->triangle[leaf]);
    std::fill_n(picture_->instance[leaf], 16, no_ray);
    store_where(rays, meets_nothing, picture_->instance[leaf]);
  }

  /// Boxes against cones, of which one side is the same sixteen times: false where no ray of the cone meets the box.
  /// `near` becomes what every point of the box that is in the cone is away at least.
  ///
  /// The plane that touches the cone on the side of the box's centre parts the two if the whole box is beyond it.
  static HWY_INLINE Mask may_meet(const Vectors& centre, const Vectors& half, const Vectors& axis, const Floats& sin,
                                  const Floats& cos, const PlacedBody& placed, Floats& near) {
    const Vectors column[3] = {all(placed.columns[0].x, placed.columns[0].y, placed.columns[0].z),
                               all(placed.columns[1].x, placed.columns[1].y, placed.columns[1].z),
                               all(placed.columns[2].x, placed.columns[2].y, placed.columns[2].z)};
    const Vectors origin = all(placed.origin.x, placed.origin.y, placed.origin.z);
    const Vectors c = transform(column, origin, centre);
    const Floats along = dot(c, axis);
    const Vectors across = c - axis * along;
    const Floats square = dot(across, across);
    // Too small by a little, which tilts the plane away from the cone.
    const Floats inverse_height = rough_inverse_sqrt(max(square, all(smallest_square))) * all(1.0f - rough);
    const Floats height = square * inverse_height;
    const Vectors outwards = across * (cos * inverse_height) - axis * sin;
    const Floats beyond = height * cos - along * sin;
    const Floats reach =
        mul_add(half.x, abs(dot(column[0], outwards)),
                mul_add(half.y, abs(dot(column[1], outwards)), half.z * abs(dot(column[2], outwards))));
    const Floats depth = mul_add(half.x, abs(dot(column[0], axis)),
                                 mul_add(half.y, abs(dot(column[1], axis)), half.z * abs(dot(column[2], axis))));
    const Floats room = mul_add(all(1e-6f), height + abs(along), all(placed.pad));
    near = (along - depth - room) * all(1.0f / placed.scale);
    return beyond <= reach + room;
  }

  static HWY_INLINE Floats length_or_more(const Vectors& v) {
    const Floats square = max(dot(v, v), all(smallest_square));
    return square * rough_inverse_sqrt(square) * all(1.0f + rough);
  }

  static HWY_INLINE Vectors transform(const Vectors* column, const Vectors& origin, const Vectors& p) {
    return {mul_add(column[0].x, p.x, mul_add(column[1].x, p.y, mul_add(column[2].x, p.z, origin.x))),
            mul_add(column[0].y, p.x, mul_add(column[1].y, p.y, mul_add(column[2].y, p.z, origin.y))),
            mul_add(column[0].z, p.x, mul_add(column[1].z, p.y, mul_add(column[2].z, p.z, origin.z)))};
  }

  /// Those that the block may see, the farthest first.
  void push_children(const BoxNode& node, const PlacedBody& body) {
    const Cone& cone = block_->cone;
    alignas(64) float near[16];
    Floats near_v;
    const Mask meets = may_meet({load(node.centre[0]), load(node.centre[1]), load(node.centre[2])},
                                {load(node.half[0]), load(node.half[1]), load(node.half[2])},
                                all(cone.axis.x, cone.axis.y, cone.axis.z), all(cone.sin), all(cone.cos), body, near_v);
    const Mask before = near_v * all(farthest_of_block_) <= all(1.0f + slack);
    uint32_t left = bits(meets & before) & ((1u << node.count) - 1u);
    store(near_v, near);
    const size_t first = count_;
    for (; left != 0; left &= left - 1) {
      const auto lane = uint32_t(std::countr_zero(left));
      size_t place = count_++;
      for (; place > first && pending_[place - 1].near < near[lane]; --place) pending_[place] = pending_[place - 1];
      pending_[place] = {&node, &body, lane, near[lane]};
      prefetch(body, node.child[lane]);
    }
  }

  /// What is pending will be wanted soon, and large scenes lie far from the processor.
  static void prefetch(const PlacedBody& body, uint32_t child) {
    constexpr size_t line = 64;
    const bool is_leaf = child & BoxNode::leaf;
    if (is_leaf && body.clusters == nullptr) return;
    const auto* from = is_leaf ? reinterpret_cast<const char*>(&body.clusters[child & ~BoxNode::leaf])
                               : reinterpret_cast<const char*>(&body.nodes[child]);
    const size_t size = is_leaf ? sizeof(Cluster) : sizeof(BoxNode);
    for (size_t offset = 0; offset < size; offset += line) hwy::Prefetch(from + offset);
  }

  void visit_cluster(const BoxNode& node, uint32_t lane, const PlacedBody& body, const PlacedPart& part,
                     const Cluster& cluster) {
    Floats near;
    const Vectors axis{load(block_->axis_x), load(block_->axis_y), load(block_->axis_z)};
    const Mask meets = may_meet(all(node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]),
                                all(node.half[0][lane], node.half[1][lane], node.half[2][lane]), axis,
                                load(block_->sin), load(block_->cos), body, near);
    const uint32_t leaves = bits(meets & (near * load(farthest_) <= all(1.0f + slack))) & block_->leaf_mask;
    if (leaves == 0) return;
    if (part.front != 0.0f) {
      visit_triangles(turn(body, part, cluster), leaves, body, part, cluster);
    } else {
      // From the side where the camera is; and those that are seen edge-on from the other, too.
      const uint32_t triangles = turn(body, part, cluster);
      visit_triangles(triangles, leaves, body, part, cluster);
      const uint32_t unsure = triangles & turned_.by_weights;
      if (unsure != 0) {
        turn_round(unsure);
        visit_triangles(unsure, leaves, body, part, cluster);
      }
    }
    bool changed = false;
    for (; dirty_ != 0; dirty_ &= dirty_ - 1, changed = true) {
      const int leaf = std::countr_zero(dirty_);
      farthest_[leaf] = least(load(picture_->inverse_distance[leaf]));
    }
    if (changed) farthest_of_block_ = least(load(farthest_));
  }

  /// Returns the triangles that the block may see: from the part's front, or, where both sides are seen, from where the
  /// camera is.
  uint32_t turn(const PlacedBody& body, const PlacedPart& part, const Cluster& cluster) {
    const float front = part.front;
    const Vectors column[3] = {all(body.columns[0].x, body.columns[0].y, body.columns[0].z),
                               all(body.columns[1].x, body.columns[1].y, body.columns[1].z),
                               all(body.columns[2].x, body.columns[2].y, body.columns[2].z)};
    const Vectors origin = all(body.origin.x, body.origin.y, body.origin.z);
    Vectors corner[3];
    for (int i = 0; i < 3; ++i) {
      corner[i] = transform(column, origin,
                            {load(cluster.corner[i][0]), load(cluster.corner[i][1]), load(cluster.corner[i][2])});
    }
    const Floats square[3] = {dot(corner[0], corner[0]), dot(corner[1], corner[1]), dot(corner[2], corner[2])};
    // From its nearest corner, whose products lose least.
    const Mask before = square[0] < square[1], last = square[2] < min(square[0], square[1]);
    const Vectors nearest = choose(last, corner[2], choose(before, corner[0], corner[1]));
    const Vectors ab = choose(last, corner[0], choose(before, corner[1], corner[2])) - nearest;
    const Vectors ac = choose(last, corner[1], choose(before, corner[2], corner[0])) - nearest;
    const Vectors normal = cross(ab, ac);
    const Floats volume = dot(normal, nearest);
    // The squares of what rounding may make of the volume.
    const Floats doubt = dot(ab, ab) * dot(ac, ac) * dot(nearest, nearest) * all(edge_on * edge_on);
    const Floats zero = all(0.0f);
    const Mask unsure = volume * volume <= doubt;
    const Floats side = front == 0.0f ? volume : all(front);
    Mask kept = abs(normal.x) + abs(normal.y) + abs(normal.z) > zero;
    if (front != 0.0f) kept = kept & ((volume * side > zero) | unsure);

    const Cone& cone = block_->cone;
    const Vectors axis = all(cone.axis.x, cone.axis.y, cone.axis.z);
    for (int i = 0; i < 3; ++i) {
      // The product of both corners, without its loss of digits where they are close to each other, or one of them is
      // far away; the same to the bit, turned round, for the triangle on the other side.
      const int from = (i + 1) % 3, to = (i + 2) % 3;
      const Vectors& p = corner[from];
      const Vectors& q = corner[to];
      const Vectors near =
          choose(square[from] < square[to], p, choose(square[to] < square[from], q, (p + q) * all(0.5f)));
      Vectors plane = cross(near, q - p);
      plane = {times_sign(plane.x, side), times_sign(plane.y, side), times_sign(plane.z, side)};
      const Floats length = length_or_more(plane);
      if (front != 0.0f)
        kept = kept & (dot(plane, axis) >= length * all(-cone.sin));
      else
        kept = kept & ((dot(plane, axis) >= length * all(-cone.sin)) | unsure);
      store(plane.x, turned_.edge[i][0]);
      store(plane.y, turned_.edge[i][1]);
      store(plane.z, turned_.edge[i][2]);
      store(length, turned_.edge_length[i]);
    }
    // Per metre only now: squares of metres need not fit.
    const Vectors scaled_depth = normal * (all(1.0f) / volume);
    const Floats depth_length = length_or_more(scaled_depth) * all(body.scale);
    const Vectors depth = scaled_depth * all(body.scale);
    const Floats most = mul_add(depth_length, all(cone.sin), abs(dot(depth, axis)));
    kept = kept & ((most * all(1.0f + slack) >= all(farthest_of_block_)) | unsure);
    store(depth.x, turned_.depth[0]);
    store(depth.y, turned_.depth[1]);
    store(depth.z, turned_.depth[2]);
    store(depth_length, turned_.depth_length);
    turned_.by_weights = bits(unsure);
    const uint32_t triangles = bits(kept);
    if ((triangles & turned_.by_weights) != 0 || part.alpha != Material::Alpha::opaque) {
      for (int i = 0; i < 3; ++i) {
        store(corner[i].x, turned_.corner[i][0]);
        store(corner[i].y, turned_.corner[i][1]);
        store(corner[i].z, turned_.corner[i][2]);
      }
    }
    return triangles;
  }

  void turn_round(uint32_t triangles) {
    for (; triangles != 0; triangles &= triangles - 1) {
      const int t = std::countr_zero(triangles);
      for (auto& edge : turned_.edge) {
        for (auto& axis : edge) axis[t] = -axis[t];
      }
    }
  }

  void visit_triangles(uint32_t triangles, uint32_t leaves, const PlacedBody& body, const PlacedPart& part,
                       const Cluster& cluster) {
    if (triangles == 0) return;
    // Whichever are fewer, one after another against sixteen of the others.
    if (std::popcount(triangles) <= std::popcount(leaves)) {
      const Vectors axis{load(block_->axis_x), load(block_->axis_y), load(block_->axis_z)};
      const Floats sin = load(block_->sin);
      for (; triangles != 0; triangles &= triangles - 1) {
        const int t = std::countr_zero(triangles);
        Mask kept = turned_near(t, axis, sin);
        for (int i = 0; i < 3; ++i) {
          const Vectors plane = all(turned_.edge[i][0][t], turned_.edge[i][1][t], turned_.edge[i][2][t]);
          kept = kept & (mul_add(all(turned_.edge_length[i][t]), sin, dot(plane, axis)) >= all(0.0f));
        }
        for (uint32_t left = bits(kept) & leaves; left != 0; left &= left - 1) {
          visit_leaf(std::countr_zero(left), t, body, part, cluster);
        }
      }
      return;
    }
    for (; leaves != 0; leaves &= leaves - 1) {
      const int leaf = std::countr_zero(leaves);
      const Cone cone = block_->leaf_cone(leaf);
      const Vectors axis = all(cone.axis.x, cone.axis.y, cone.axis.z);
      const Floats sin = all(cone.sin);
      Mask kept = (mul_add(load(turned_.depth_length), sin,
                           abs(dot({load(turned_.depth[0]), load(turned_.depth[1]), load(turned_.depth[2])}, axis))) *
                   all(1.0f + slack)) >= all(farthest_[leaf]);
      kept = kept | from_bits(turned_.by_weights);
      for (int i = 0; i < 3; ++i) {
        const Vectors plane{load(turned_.edge[i][0]), load(turned_.edge[i][1]), load(turned_.edge[i][2])};
        kept = kept & (mul_add(load(turned_.edge_length[i]), sin, dot(plane, axis)) >= all(0.0f));
      }
      for (uint32_t left = bits(kept) & triangles; left != 0; left &= left - 1) {
        visit_leaf(leaf, std::countr_zero(left), body, part, cluster);
      }
    }
  }

  /// Leaves in which triangle `t` may be nearer than what is there.
  HWY_INLINE Mask turned_near(int t, const Vectors& axis, const Floats& sin) const {
    if (turned_.by_weights >> t & 1) return all(0.0f) == all(0.0f);
    const Vectors depth = all(turned_.depth[0][t], turned_.depth[1][t], turned_.depth[2][t]);
    return mul_add(all(turned_.depth_length[t]), sin, abs(dot(depth, axis))) * all(1.0f + slack) >= load(farthest_);
  }

  void visit_leaf(int leaf, int t, const PlacedBody& body, const PlacedPart& part, const Cluster& cluster) {
    const Vectors ray{load(block_->x[leaf]), load(block_->y[leaf]), load(block_->z[leaf])};
    const Floats zero = all(0.0f);
    Floats inside[3];
    for (int i = 0; i < 3; ++i) {
      inside[i] = dot(all(turned_.edge[i][0][t], turned_.edge[i][1][t], turned_.edge[i][2][t]), ray);
    }
    Mask hit = (inside[0] >= zero) & (inside[1] >= zero) & (inside[2] >= zero);
    Floats inverse;
    if (turned_.by_weights >> t & 1) {
      Floats distance = zero, doubt = zero;
      for (int i = 0; i < 3; ++i) {
        const Vectors corner = all(turned_.corner[i][0][t], turned_.corner[i][1][t], turned_.corner[i][2][t]);
        distance = mul_add(inside[i], dot(corner, ray), distance);
        const Vectors plane = all(turned_.edge[i][0][t], turned_.edge[i][1][t], turned_.edge[i][2][t]);
        const Floats rounding = mul_add(inside[i], all(1e-6f), dot(abs(plane), abs(ray)) * all(3e-7f));
        doubt = mul_add(rounding, dot(abs(corner), abs(ray)), doubt);
      }
      // A triangle around the centre, in a plane through it, is met nowhere else: there, terms cancel but for rounding.
      hit = hit & (distance > doubt);
      inverse = (inside[0] + inside[1] + inside[2]) * all(body.scale) / distance;
    } else {
      inverse = dot(all(turned_.depth[0][t], turned_.depth[1][t], turned_.depth[2][t]), ray);
    }
    const uint32_t triangle = part.first_triangle + cluster.triangle[t];
    const Floats seen = load(picture_->inverse_distance[leaf]);
    Mask nearer = inverse > seen;
    if (!query_.collect) nearer = nearer | ((inverse == seen) & larger(picture_->triangle[leaf], triangle));
    hit = hit & nearer & (inverse > zero);
    uint32_t found = bits(hit);
    if (found == 0) return;
    if (part.alpha != Material::Alpha::opaque) {
      if (query_.collect) {
        collect(leaf, t, found, triangle, part, inside, inverse);
        return;
      }
      found = without_holes(found, cluster.triangle[t], part, inside);
      if (found == 0) return;
      hit = from_bits(found);
    }
    store_where(hit, inverse, picture_->inverse_distance[leaf]);
    store_where(hit, triangle, picture_->triangle[leaf]);
    store_where(hit, part.instance, picture_->instance[leaf]);
    dirty_ |= 1u << leaf;
  }

  uint32_t without_holes(uint32_t found, uint32_t triangle, const PlacedPart& part, const Floats* inside) const {
    alignas(64) float weight[3][16];
    for (int i = 0; i < 3; ++i) store(inside[i], weight[i]);
    const float cutoff = part.alpha == Material::Alpha::blend ? label_alpha_cutoff : part.cutoff;
    for (uint32_t left = found; left != 0; left &= left - 1) {
      const int ray = std::countr_zero(left);
      const float sum = weight[0][ray] + weight[1][ray] + weight[2][ray];
      const float alpha =
          coverage(query_.scene->scene(), *part.mesh, triangle, weight[1][ray] / sum, weight[2][ray] / sum);
      if (!(alpha >= cutoff)) found &= ~(1u << ray);
    }
    return found;
  }

  /// A ray through an edge belongs to the side whose plane's first number that is not zero is positive.
  bool owns(int edge, int t) const {
    for (const auto& axis : turned_.edge[edge]) {
      if (axis[t] != 0.0f) return axis[t] > 0.0f;
    }
    return true;
  }

  void collect(int leaf, int t, uint32_t found, uint32_t triangle, const PlacedPart& part, const Floats* inside,
               const Floats& inverse) {
    alignas(64) float weight[3][16], near[16];
    for (int i = 0; i < 3; ++i) store(inside[i], weight[i]);
    store(inverse, near);
    for (; found != 0; found &= found - 1) {
      const int ray = std::countr_zero(found);
      bool owned = true;
      for (int i = 0; i < 3; ++i) owned = owned && (weight[i][ray] != 0.0f || owns(i, t));
      if (owned) layers_->push_back({uint32_t(leaf), uint32_t(ray), {triangle, part.instance, 1.0f / near[ray]}});
    }
  }

  const BlockQuery& query_;
  const RayBlock* block_ = nullptr;
  BlockPicture* picture_ = nullptr;
  std::vector<BlockLayer>* layers_ = nullptr;
  std::vector<Pending> pending_;
  size_t count_ = 0;
  TurnedTriangles turned_;
  alignas(64) float farthest_[16] = {};  ///< inverse distance of the farthest thing that a leaf's rays see
  float farthest_of_block_ = 0.0f;
  uint32_t dirty_ = 0;  ///< leaves whose `farthest_` is to be found again
};

void find_blocks(const BlockQuery& query, std::span<const RayBlock> blocks, const BlockSource& source,
                 const BlockSink& sink) {
  BlockFinder finder(query);
  BlockPicture picture;
  std::vector<BlockLayer> layers;
  for (const RayBlock& block : blocks) {
    layers.clear();
    if (query.collect) source(block, picture);
    finder.find(block, picture, layers);
    sink(block, picture, layers);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
