#include "omma/visibility/box_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

namespace omma {

void BoxNode::set_box(uint32_t lane, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const float c = 0.5f * box.min[axis] + 0.5f * box.max[axis];
    centre[axis][lane] = c;
    half[axis][lane] = std::max(box.max[axis] - c, c - box.min[axis]) * 1.000001f;
  }
}

Box BoxNode::box(uint32_t lane) const {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = centre[axis][lane] - half[axis][lane];
    box.max[axis] = centre[axis][lane] + half[axis][lane];
  }
  return box;
}

Box BoxNode::bounds() const {
  Box whole;
  for (uint32_t lane = 0; lane < count; ++lane) whole.add(box(lane));
  return whole;
}

void BoxTree::refit(std::span<const Box> boxes) {
  for (size_t n = nodes.size(); n-- > 0;) {
    BoxNode& node = nodes[n];
    for (uint32_t lane = 0; lane < node.count; ++lane) {
      const uint32_t child = node.child[lane];
      node.set_box(lane, child & BoxNode::leaf ? boxes[child & ~BoxNode::leaf] : nodes[child].bounds());
    }
  }
}

namespace {

/// A binary tree by the surface area heuristic, which is then opened to sixteen children a node.
struct Part {
  Box box;
  uint32_t first = 0, count = 0;
  std::unique_ptr<Part> left, right;  ///< both or none
};

constexpr int bins = 16;
constexpr float gain = 0.5f;  ///< two leaves are better than one when their areas together are less than this share
constexpr int depth_by_area = 40;  ///< deeper down parts are halved, which bounds the tree's depth
constexpr uint32_t parallel_size = 4096;

class Builder {
 public:
  Builder(std::span<const Box> boxes, uint32_t leaf_size) : boxes_(boxes), leaf_size_(leaf_size), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  std::unique_ptr<Part> split(uint32_t first, uint32_t count, int depth) {
    auto part = std::make_unique<Part>();
    part->first = first;
    part->count = count;
    for (uint32_t i = first; i < first + count; ++i) part->box.add(boxes_[order_[i]]);
    if (count == 1) return part;
    uint32_t left = 0;
    if (count <= leaf_size_) {
      left = sweep(first, count, 1, gain * part->box.half_area());
      if (left == 0) return part;
    } else {
      if (depth < depth_by_area) {
        left = count <= 8 * leaf_size_ ? sweep(first, count, leaf_size_, std::numeric_limits<float>::infinity())
                                       : bin(first, count);
      }
      if (left == 0) left = halve(part->box, first, count);
    }
    const auto split_left = [&] { part->left = split(first, left, depth + 1); };
    const auto split_right = [&] { part->right = split(first + left, count - left, depth + 1); };
    if (count > parallel_size) {
      tbb::parallel_invoke(split_left, split_right);
    } else {
      split_left();
      split_right();
    }
    return part;
  }

  std::vector<uint32_t> take_order() { return std::move(order_); }

 private:
  /// Twice the centre: halving gains nothing.
  float centre(uint32_t i, int axis) const { return boxes_[i].min[axis] + boxes_[i].max[axis]; }
  float cost(const Box& box, uint32_t count) const {
    return box.half_area() * float((count + leaf_size_ - 1) / leaf_size_);
  }
  void sort(uint32_t first, uint32_t count, int axis) {
    std::sort(order_.begin() + first, order_.begin() + first + count, [&](uint32_t a, uint32_t b) {
      const float ca = centre(a, axis), cb = centre(b, axis);
      return ca != cb ? ca < cb : a < b;
    });
  }

  /// Each of these returns how many go to the left; 0 when there is no way to tell.
  uint32_t halve(const Box& box, uint32_t first, uint32_t count) {
    const glm::vec3 extent = box.max - box.min;
    sort(first, count, extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2);
    return (count / 2 + leaf_size_ - 1) / leaf_size_ * leaf_size_;
  }

  /// Tries every `step`-th border; takes the best if it costs less than `least`.
  uint32_t sweep(uint32_t first, uint32_t count, uint32_t step, float least) {
    int best_axis = -1;
    uint32_t best = 0;
    std::vector<Box> right(count + 1);
    for (int axis = 0; axis < 3; ++axis) {
      sort(first, count, axis);
      for (uint32_t i = count; i-- > 0;) {
        right[i] = right[i + 1];
        right[i].add(boxes_[order_[first + i]]);
      }
      Box left;
      for (uint32_t i = 1; i < count; ++i) {
        left.add(boxes_[order_[first + i - 1]]);
        if (i % step != 0) continue;
        const float c = cost(left, i) + cost(right[i], count - i);
        if (c < least) {
          least = c;
          best_axis = axis;
          best = i;
        }
      }
    }
    if (best_axis >= 0 && best_axis != 2) sort(first, count, best_axis);
    return best;
  }

  uint32_t bin(uint32_t first, uint32_t count) {
    Box centres;
    for (uint32_t i = first; i < first + count; ++i) {
      centres.add({centre(order_[i], 0), centre(order_[i], 1), centre(order_[i], 2)});
    }
    const glm::vec3 extent = centres.max - centres.min;
    const auto bin_of = [&](uint32_t i, int axis) {
      const float share = (centre(i, axis) - centres.min[axis]) / extent[axis];
      return std::clamp(int(share * float(bins)), 0, bins - 1);
    };
    float least = std::numeric_limits<float>::infinity();
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(extent[axis] > 0.0f) || !std::isfinite(extent[axis])) continue;
      std::array<Box, bins> box;
      std::array<uint32_t, bins> counts{};
      for (uint32_t i = first; i < first + count; ++i) {
        const auto b = size_t(bin_of(order_[i], axis));
        box[b].add(boxes_[order_[i]]);
        ++counts[b];
      }
      std::array<float, bins> right_cost{};
      Box right;
      uint32_t right_count = 0;
      for (size_t b = bins; b-- > 1;) {
        right.add(box[b]);
        right_count += counts[b];
        right_cost[b] = right_count > 0 ? cost(right, right_count) : 0.0f;
      }
      Box left;
      uint32_t left_count = 0;
      for (size_t b = 1; b < bins; ++b) {
        left.add(box[b - 1]);
        left_count += counts[b - 1];
        if (left_count == 0 || left_count == count) continue;
        const float c = cost(left, left_count) + right_cost[b];
        if (c < least) {
          least = c;
          best_axis = axis;
          best_bin = int(b);
        }
      }
    }
    if (best_axis < 0) return 0;
    const auto middle = std::stable_partition(order_.begin() + first, order_.begin() + first + count,
                                              [&](uint32_t i) { return bin_of(i, best_axis) < best_bin; });
    return uint32_t(middle - order_.begin()) - first;
  }

  std::span<const Box> boxes_;
  uint32_t leaf_size_;
  std::vector<uint32_t> order_;
};

/// Adds a node for `part` and returns its depth. The part that costs most is opened first.
uint32_t widen(const Part& part, BoxTree& tree) {
  std::vector<const Part*> children{&part};
  while (children.size() < BoxNode::width) {
    size_t largest = children.size();
    for (size_t i = 0; i < children.size(); ++i) {
      if (!children[i]->left) continue;
      if (largest == children.size() || children[i]->box.half_area() > children[largest]->box.half_area()) largest = i;
    }
    if (largest == children.size()) break;
    const Part* opened = children[largest];
    children[largest] = opened->left.get();
    children.push_back(opened->right.get());
  }
  const size_t number = tree.nodes.size();
  tree.nodes.emplace_back();
  tree.nodes[number].count = uint32_t(children.size());
  uint32_t depth = 0;
  for (uint32_t lane = 0; lane < children.size(); ++lane) {
    const Part& child = *children[lane];
    uint32_t reference;
    if (child.left) {
      reference = uint32_t(tree.nodes.size());
      depth = std::max(depth, widen(child, tree));
    } else {
      reference = BoxNode::leaf | uint32_t(tree.leaves.size());
      tree.leaves.push_back({child.first, child.count});
    }
    tree.nodes[number].set_box(lane, child.box);
    tree.nodes[number].child[lane] = reference;
  }
  return depth + 1;
}

}  // namespace

BoxTree build_box_tree(std::span<const Box> boxes, uint32_t leaf_size) {
  BoxTree tree;
  if (boxes.empty()) return tree;
  Builder builder(boxes, leaf_size);
  const std::unique_ptr<Part> root = builder.split(0, uint32_t(boxes.size()), 0);
  tree.depth = widen(*root, tree);
  tree.order = builder.take_order();
  return tree;
}

}  // namespace omma
