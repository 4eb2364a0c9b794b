// A binary tree of boxes by the surface area heuristic: what a tree with wide nodes is made from.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "omma/visibility/box.h"

namespace omma {

struct AreaTree {
  struct Part {
    Box box;
    uint32_t first = 0, count = 0;      ///< of `order`
    std::unique_ptr<Part> left, right;  ///< both or none
  };
  static constexpr uint32_t largest_leaf = 128;

  std::unique_ptr<Part> root;
  std::vector<uint32_t> order;  ///< numbers of what it was built over

  /// At least one box, all finite; 1 to `largest_leaf` of them a leaf at most, fewer where that parts what lies far
  /// apart. Runs on all cores; the result does not depend on how many.
  AreaTree(std::span<const Box> boxes, uint32_t leaf_size);
};

}  // namespace omma
