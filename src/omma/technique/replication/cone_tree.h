// What triangles are sent into: parts of an image, under a tree of cones around their rays.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "omma/gl/program.h"

namespace omma {

/// Two texels, as in shaders/technique/replication/cone_tree.glsl. Nodes lie in the order of a walk that visits a node
/// before its children, which come one after another.
struct ConeNode {
  static constexpr uint32_t no_piece = 0xffffffffu;

  /// A cone of that half angle (radians) around a unit axis.
  ConeNode(const glm::dvec3& axis, double angle, uint32_t piece, uint32_t data = 0);

  glm::vec4 cone;   ///< the axis and the sine of the half angle, 2 where that is a right angle or nearly so
  glm::uvec4 link;  ///< the node after this one's descendants, piece or no_piece, the cosine's bits, data
};

class ConeTree {
 public:
  virtual ~ConeTree() = default;
  /// Binds the nodes to texture unit 18, and whatever else the shader that COVERAGE names reads.
  virtual void bind() const = 0;
  virtual void set_uniforms(const gl::Program& program) const = 0;
  /// COVERAGE: the file with `next_piece`, the parts of the image that a triangle reaches; and the symbols it wants.
  virtual gl::Defines coverage_defines() const = 0;
};

}  // namespace omma
