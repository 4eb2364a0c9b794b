// A tree of boxes with sixteen children a node, one SIMD register: over a mesh's triangles, or over a scene's
// instances.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace omma {

struct Box {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  float half_area() const {
    const glm::vec3 e = max - min;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

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

/// At most `leaf_size` boxes a leaf. Boxes are finite. Runs on all cores; the result does not depend on how many.
BoxTree build_box_tree(std::span<const Box> boxes, uint32_t leaf_size);

}  // namespace omma
