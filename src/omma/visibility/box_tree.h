// A tree of boxes with sixteen children a node, one SIMD register: over a mesh's triangles, or over a scene's
// instances.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "omma/visibility/box.h"

namespace omma {

struct alignas(64) BoxNode {
  static constexpr uint32_t width = 16;
  static constexpr uint32_t leaf = 0x80000000u;  ///< marks a child that is a leaf's number; others are nodes'

  float centre[3][width], half[3][width];
  uint32_t child[width];
  uint32_t tag[width];  ///< of a leaf: for whoever built the tree
  uint32_t count;       ///< of children; the rest of the arrays is zero

  /// Rounded outwards.
  void set_box(uint32_t lane, const Box& box);
  Box box(uint32_t lane) const;
  Box bounds() const;
};

struct BoxTree {
  struct Leaf {
    uint32_t first, count;  ///< of `order`
  };
  std::vector<BoxNode> nodes;   ///< the root first, parents before their children; empty when nothing is in it
  std::vector<Leaf> leaves;     ///< in the order in which nodes speak of them
  std::vector<uint32_t> order;  ///< numbers of what it was built over
  uint32_t depth = 0;           ///< of nodes

  /// New boxes of the leaves: takes them up to the root.
  void refit(std::span<const Box> boxes);
};

/// 1 to 128 boxes a leaf at most. Boxes are finite. Runs on all cores; the result does not depend on how many.
BoxTree build_box_tree(std::span<const Box> boxes, uint32_t leaf_size);

}  // namespace omma
