#include "omma/technique/replication/cone_tree.h"

#include <bit>
#include <cmath>

namespace omma {

ConeNode::ConeNode(const glm::dvec3& axis, double angle, uint32_t piece, uint32_t data)
    : cone(glm::vec3(axis), std::cos(angle) < 1e-3 ? 2.0f : float(std::sin(angle))),
      link(0, piece, std::bit_cast<uint32_t>(float(std::cos(angle))), data) {}

}  // namespace omma
