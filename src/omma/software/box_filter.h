// An image's next smaller level: half as large, at least one, each texel the mean of what it covers.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace omma {

/// Texels of one axis that a texel of the next level covers, and how much of each: three where the size is odd.
struct Covered {
  int first;
  float weight[3];
};

/// For each of the `next` texels.
std::vector<Covered> covered_by_next_level(int size, int next);

/// `level` has size.x * size.y values, rows from the top, the result next_size(size). Where a side is odd, texels cover
/// parts of three.
std::vector<glm::vec4> next_level(const std::vector<glm::vec4>& level, glm::ivec2 size);

inline glm::ivec2 next_size(glm::ivec2 size) { return glm::max(size / 2, 1); }

}  // namespace omma
