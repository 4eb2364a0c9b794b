#include "omma/visibility/box_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "omma/visibility/area_tree.h"

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

using Part = AreaTree::Part;

constexpr uint32_t parallel_size = 4096;

/// What the nodes below a part cost to look at, in areas, if it may become up to one, two, ... sixteen children of the
/// node above.
using Costs = std::array<float, BoxNode::width>;

/// A part of the binary tree with its costs.
struct Priced {
  const Part* part = nullptr;
  Costs costs{};
  std::unique_ptr<Priced> left, right;
};

/// How `room` for children, at least two, is shared between both halves of a part at the least cost.
struct Share {
  float cost = std::numeric_limits<float>::infinity();
  uint32_t left = 1;

  Share(const Priced& whole, uint32_t room) {
    for (uint32_t l = 1; l < room; ++l) {
      const float c = whole.left->costs[l - 1] + whole.right->costs[room - l - 1];
      if (c < cost) {
        cost = c;
        left = l;
      }
    }
  }
};

std::unique_ptr<Priced> price(const Part& part) {
  auto priced = std::make_unique<Priced>();
  priced->part = &part;
  if (!part.left) return priced;
  const auto price_left = [&] { priced->left = price(*part.left); };
  const auto price_right = [&] { priced->right = price(*part.right); };
  if (part.count > parallel_size) {
    tbb::parallel_invoke(price_left, price_right);
  } else {
    price_left();
    price_right();
  }
  const float as_node = part.box.half_area() + Share(*priced, BoxNode::width).cost;
  priced->costs[0] = as_node;
  for (uint32_t room = 2; room <= BoxNode::width; ++room) {
    priced->costs[room - 1] = std::min(as_node, Share(*priced, room).cost);
  }
  return priced;
}

/// Makes a part up to `room` children, of which each is a leaf or becomes a node.
void take_apart(const Priced& priced, uint32_t room, bool is_root, std::vector<const Priced*>& children) {
  if (priced.left && room > 1) {
    const Share share(priced, room);
    if (is_root || !(priced.costs[0] < share.cost)) {
      take_apart(*priced.left, share.left, false, children);
      take_apart(*priced.right, room - share.left, false, children);
      return;
    }
  }
  children.push_back(&priced);
}

/// Adds a node for `priced` and returns its depth.
uint32_t widen(const Priced& priced, BoxTree& tree) {
  std::vector<const Priced*> children;
  take_apart(priced, BoxNode::width, true, children);
  const size_t number = tree.nodes.size();
  tree.nodes.emplace_back();
  tree.nodes[number].count = uint32_t(children.size());
  uint32_t depth = 0;
  for (uint32_t lane = 0; lane < children.size(); ++lane) {
    const Part& child = *children[lane]->part;
    uint32_t reference;
    if (child.left) {
      reference = uint32_t(tree.nodes.size());
      depth = std::max(depth, widen(*children[lane], tree));
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
  AreaTree by_area(boxes, leaf_size);
  tree.depth = widen(*price(*by_area.root), tree);
  tree.order = std::move(by_area.order);
  return tree;
}

}  // namespace omma
