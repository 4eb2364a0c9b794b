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

#include "omma/scene/coverage.h"
#include "omma/visibility/block_sight-inl.h"
#include "omma/visibility/find_blocks.h"
#include "omma/visibility/pending-inl.h"
#include "omma/visibility/turned_cluster-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// `has_origins`: rays begin beside the apex of their block, which stands in for the camera's centre. A triangle in
/// whose plane some of them may begin is seen edge-on, as far as sides and distances go.
template <bool has_origins>
class BlockFinder {
 public:
  explicit BlockFinder(const BlockQuery& query) : query_(query), pending_(query.scene->index().depth()) {}

  /// `origins` is null where rays have none.
  void find(const RayBlock& block, const BlockOrigins* origins, BlockPicture& picture,
            std::vector<BlockLayer>& layers) {
    block_ = &block;
    origins_ = origins;
    picture_ = &picture;
    layers_ = &layers;
    sight_.forget();
    const BoxTree& top = query_.scene->top();
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      if (!query_.collect) clear(leaf);
      farthest_[leaf] = least(load(picture.inverse_distance[leaf]));
    }
    farthest_of_block_ = least(load(farthest_));
    if (top.nodes.empty() || block.leaf_mask == 0) return;
    pending_.clear();
    push_children(top.nodes[0], query_.scene->top_frame());
    while (!pending_.empty()) {
      const Pending next = pending_.pop();
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

  /// Those that the block may see.
  HWY_INLINE void push_children(const BoxNode& node, const PlacedBody& body) {
    if (!sight_.is_for(body)) sight_.look(*block_, body, apex_of<has_origins>(body, origins_));
    alignas(64) float near[16];
    Floats near_v;
    const Mask meets = sight_.may_meet({load(node.centre[0]), load(node.centre[1]), load(node.centre[2])},
                                       {load(node.half[0]), load(node.half[1]), load(node.half[2])}, near_v);
    const Mask before = near_v * all(farthest_of_block_) <= all(1.0f + slack);
    store(near_v, near);
    pending_.push(node, body, bits(meets & before) & ((1u << node.count) - 1u), near);
  }

  HWY_INLINE void visit_cluster(const BoxNode& node, uint32_t lane, const PlacedBody& body, const PlacedPart& part,
                                const Cluster& cluster) {
    Floats near;
    const Vectors axis{load(block_->axis_x), load(block_->axis_y), load(block_->axis_z)};
    const Mask meets = may_meet(all(node.centre[0][lane], node.centre[1][lane], node.centre[2][lane]),
                                all(node.half[0][lane], node.half[1][lane], node.half[2][lane]), axis,
                                load(block_->sin), load(block_->cos), body, apex_of<has_origins>(body, origins_), near);
    const uint32_t leaves = bits(meets & (near * load(farthest_) <= all(1.0f + slack))) & block_->leaf_mask;
    if (leaves == 0 || part.hidden) return;
    if (part.front != 0.0f) {
      visit_triangles(turned_.turn(*block_, origins_, farthest_of_block_, body, part, cluster), leaves, body, part,
                      cluster);
    } else {
      // From the side where the camera is; and those that are seen edge-on from the other, too.
      const uint32_t triangles = turned_.turn(*block_, origins_, farthest_of_block_, body, part, cluster);
      visit_triangles(triangles, leaves, body, part, cluster);
      const uint32_t unsure = triangles & turned_.by_weights;
      if (unsure != 0) {
        turned_.turn_round(unsure);
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

  void visit_triangles(uint32_t triangles, uint32_t leaves, const PlacedBody& body, const PlacedPart& part,
                       const Cluster& cluster) {
    const Vectors axis{load(block_->axis_x), load(block_->axis_y), load(block_->axis_z)};
    const Floats sin = load(block_->sin);
    for (; triangles != 0; triangles &= triangles - 1) {
      const int t = std::countr_zero(triangles);
      uint32_t left = leaves;
      if constexpr (!has_origins) left &= turned_.pixels.leaves(t);
      if (left == 0) continue;
      if ((left & (left - 1)) != 0) {
        Mask kept = turned_near(t, axis, sin);
        for (int i = 0; i < 3; ++i) {
          const Vectors plane = all(turned_.edge[i][0][t], turned_.edge[i][1][t], turned_.edge[i][2][t]);
          Floats most = mul_add(all(turned_.edge_length[i][t]), sin, dot(plane, axis));
          if constexpr (has_origins) most = most + all(turned_.apart.edge_room[i][t]);
          kept = kept & (most >= all(0.0f));
        }
        left &= bits(kept);
      }
      for (; left != 0; left &= left - 1) visit_leaf(std::countr_zero(left), t, body, part, cluster);
    }
  }

  /// Leaves in which triangle `t` may be nearer than what is there.
  HWY_INLINE Mask turned_near(int t, const Vectors& axis, const Floats& sin) const {
    if (turned_.by_weights >> t & 1) return all(0.0f) == all(0.0f);
    const Vectors depth = all(turned_.depth[0][t], turned_.depth[1][t], turned_.depth[2][t]);
    Floats nearest = mul_add(all(turned_.depth_length[t]), sin, abs(dot(depth, axis)));
    if constexpr (has_origins) nearest = nearest * all(turned_.apart.nearer[t]);
    return nearest * all(1.0f + slack) >= load(farthest_);
  }

  void visit_leaf(int leaf, int t, const PlacedBody& body, const PlacedPart& part, const Cluster& cluster) {
    const Vectors ray{load(block_->x[leaf]), load(block_->y[leaf]), load(block_->z[leaf])};
    const Floats zero = all(0.0f);
    Floats inside[3];
    for (int i = 0; i < 3; ++i) {
      inside[i] = dot(all(turned_.edge[i][0][t], turned_.edge[i][1][t], turned_.edge[i][2][t]), ray);
      if constexpr (has_origins) {
        const Vectors moment{load(origins_->moment_x[leaf]), load(origins_->moment_y[leaf]),
                             load(origins_->moment_z[leaf])};
        inside[i] =
            inside[i] +
            dot(all(turned_.apart.span[i][0][t], turned_.apart.span[i][1][t], turned_.apart.span[i][2][t]), moment);
      }
    }
    Mask hit = (inside[0] >= zero) & (inside[1] >= zero) & (inside[2] >= zero);
    Floats inverse;
    if (turned_.by_weights >> t & 1) {
      Floats distance = zero, doubt = zero;
      for (int i = 0; i < 3; ++i) {
        const Vectors corner = all(turned_.corner[i][0][t], turned_.corner[i][1][t], turned_.corner[i][2][t]);
        Floats along = dot(corner, ray), most_along = dot(abs(corner), abs(ray));
        const Vectors plane = all(turned_.edge[i][0][t], turned_.edge[i][1][t], turned_.edge[i][2][t]);
        Floats terms = dot(abs(plane), abs(ray));
        if constexpr (has_origins) {
          const Floats back = load(origins_->along[leaf]) * all(body.scale);
          along = along - back;
          most_along = most_along + abs(back);
          terms = terms + all(turned_.apart.edge_room[i][t]);
        }
        distance = mul_add(inside[i], along, distance);
        doubt = mul_add(mul_add(inside[i], all(1e-6f), terms * all(3e-7f)), most_along, doubt);
      }
      // A triangle around the centre, in a plane through it, is met nowhere else: there, terms cancel but for rounding.
      hit = hit & (distance > doubt);
      inverse = (inside[0] + inside[1] + inside[2]) * all(body.scale) / distance;
    } else {
      const Vectors depth = all(turned_.depth[0][t], turned_.depth[1][t], turned_.depth[2][t]);
      inverse = dot(depth, ray);
      if constexpr (has_origins) {
        inverse = inverse /
                  (all(1.0f) - dot(depth, {load(origins_->x[leaf]), load(origins_->y[leaf]), load(origins_->z[leaf])}));
      }
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
    for (uint32_t left = found; left != 0; left &= left - 1) {
      const int ray = std::countr_zero(left);
      const float sum = weight[0][ray] + weight[1][ray] + weight[2][ray];
      const float alpha =
          coverage(query_.scene->scene(), *part.mesh, triangle, weight[1][ray] / sum, weight[2][ray] / sum);
      if (!(alpha >= part.cutoff)) found &= ~(1u << ray);
    }
    return found;
  }

  void collect(int leaf, int t, uint32_t found, uint32_t triangle, const PlacedPart& part, const Floats* inside,
               const Floats& inverse) {
    alignas(64) float weight[3][16], near[16];
    for (int i = 0; i < 3; ++i) store(inside[i], weight[i]);
    store(inverse, near);
    for (; found != 0; found &= found - 1) {
      const int ray = std::countr_zero(found);
      bool owned = true;
      for (int i = 0; i < 3; ++i) owned = owned && (weight[i][ray] != 0.0f || turned_.owns(i, t));
      if (owned) layers_->push_back({uint32_t(leaf), uint32_t(ray), {triangle, part.instance, 1.0f / near[ray]}});
    }
  }

  const BlockQuery& query_;
  const RayBlock* block_ = nullptr;
  const BlockOrigins* origins_ = nullptr;
  BlockPicture* picture_ = nullptr;
  std::vector<BlockLayer>* layers_ = nullptr;
  PendingStack pending_;
  BlockSight sight_;
  TurnedCluster<has_origins> turned_;
  alignas(64) float farthest_[16] = {};  ///< inverse distance of the farthest thing that a leaf's rays see
  float farthest_of_block_ = 0.0f;
  uint32_t dirty_ = 0;  ///< leaves whose `farthest_` is to be found again
};

template <bool has_origins>
void find_all(const BlockQuery& query, std::span<const RayBlock> blocks, std::span<const BlockOrigins> origins,
              const BlockSource& source, const BlockSink& sink) {
  BlockFinder<has_origins> finder(query);
  BlockPicture picture;
  std::vector<BlockLayer> layers;
  for (size_t i = 0; i < blocks.size(); ++i) {
    layers.clear();
    if (query.collect) source(blocks[i], picture);
    finder.find(blocks[i], has_origins ? &origins[i] : nullptr, picture, layers);
    sink(blocks[i], picture, layers);
  }
}

void find_blocks(const BlockQuery& query, std::span<const RayBlock> blocks, std::span<const BlockOrigins> origins,
                 const BlockSource& source, const BlockSink& sink) {
  if (origins.empty()) return find_all<false>(query, blocks, origins, source, sink);
  find_all<true>(query, blocks, origins, source, sink);
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
