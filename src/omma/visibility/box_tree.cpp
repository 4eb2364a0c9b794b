#include "omma/visibility/box_tree.h"

#include <algorithm>
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
  AreaTree by_area(boxes, leaf_size);
  tree.depth = widen(*by_area.root, tree);
  tree.order = std::move(by_area.order);
  return tree;
}

}  // namespace omma
