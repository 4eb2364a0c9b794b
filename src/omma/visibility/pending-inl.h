// What of the tree of boxes is still to be visited. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_VISIBILITY_PENDING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_PENDING_INL_H_
#undef OMMA_VISIBILITY_PENDING_INL_H_
#else
#define OMMA_VISIBILITY_PENDING_INL_H_
#endif

#include <bit>
#include <vector>

#include <hwy/cache_control.h>

#include "omma/visibility/placed_scene.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// A child of a node that is still to be visited.
struct Pending {
  const BoxNode* node;
  const PlacedBody* body;  ///< the tree over bodies has a frame of its own
  uint32_t lane;
  float near;  ///< metres, at most what any of its points is away
};

/// The last that came is the first that goes.
class PendingStack {
 public:
  /// `depth`: of nodes. Each on the way down leaves at most its other children behind.
  explicit PendingStack(uint32_t depth) : pending_(size_t(depth + 1) * BoxNode::width) {}

  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }
  Pending pop() { return pending_[--count_]; }

  /// The node's `children`, by their lanes: the nearest will be the first to go.
  HWY_INLINE void push(const BoxNode& node, const PlacedBody& body, uint32_t children, const float* near) {
    const size_t first = count_;
    for (; children != 0; children &= children - 1) {
      const auto lane = uint32_t(std::countr_zero(children));
      size_t place = count_++;
      for (; place > first && pending_[place - 1].near < near[lane]; --place) pending_[place] = pending_[place - 1];
      pending_[place] = {&node, &body, lane, near[lane]};
      prefetch(body, node.child[lane]);
    }
  }

 private:
  /// What is pending will be wanted soon, and large scenes lie far from the processor. Inlined by
  /// force: of a call, GCC would say that it has no effect, and leave it out.
  static HWY_INLINE void prefetch(const PlacedBody& body, uint32_t child) {
    constexpr size_t line = 64;
    const bool is_leaf = child & BoxNode::leaf;
    if (is_leaf && body.clusters == nullptr) return;
    const auto* from = is_leaf ? reinterpret_cast<const char*>(&body.clusters[child & ~BoxNode::leaf])
                               : reinterpret_cast<const char*>(&body.nodes[child]);
    const size_t size = is_leaf ? sizeof(Cluster) : sizeof(BoxNode);
    for (size_t offset = 0; offset < size; offset += line) hwy::Prefetch(from + offset);
  }

  std::vector<Pending> pending_;
  size_t count_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
