#include "omma/software/box_filter.h"

#include <algorithm>

namespace omma {
std::vector<Covered> covered_by_next_level(int size, int next) {
  std::vector<Covered> all(size_t(next), Covered{});
  const double step = double(size) / double(next);
  for (int i = 0; i < next; ++i) {
    const double begin = i * step, end = begin + step;
    Covered& covered = all[size_t(i)];
    covered.first = std::min(int(begin), size - 1);
    for (int k = 0; k < 3; ++k) {
      const double low = std::max(begin, double(covered.first + k));
      const double high = std::min(end, double(covered.first + k + 1));
      covered.weight[k] = float(std::max(0.0, high - low) / step);
    }
  }
  return all;
}

std::vector<glm::vec4> next_level(const std::vector<glm::vec4>& level, glm::ivec2 size) {
  const glm::ivec2 next = next_size(size);
  const std::vector<Covered> across = covered_by_next_level(size.x, next.x);
  const std::vector<Covered> down = covered_by_next_level(size.y, next.y);
  std::vector<glm::vec4> result(size_t(next.x) * size_t(next.y));
  for (int y = 0; y < next.y; ++y) {
    for (int x = 0; x < next.x; ++x) {
      glm::vec4 sum(0.0f);
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
          const float weight = across[size_t(x)].weight[i] * down[size_t(y)].weight[j];
          if (weight == 0.0f) continue;
          const int column = across[size_t(x)].first + i, row = down[size_t(y)].first + j;
          sum += weight * level[size_t(row) * size_t(size.x) + size_t(column)];
        }
      }
      result[size_t(y) * size_t(next.x) + size_t(x)] = sum;
    }
  }
  return result;
}

}  // namespace omma
