#include "omma/technique/visible_squares.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace omma {

VisibleSquares::VisibleSquares(const Scene& scene)
    : scene_(scene), seen_(scene.triangle_count()), place_(scene.triangle_count()) {}

void VisibleSquares::sort(const VisibleTriangles& visible, std::span<uint32_t> places) {
  const int width = visible.size.width, height = visible.size.height;
  const glm::ivec2 count((width + side - 1) / side, (height + side - 1) / side);
  const auto row_of = [&](int y) { return visible.hits.data() + size_t(y) * size_t(width); };

  // Neighbours mostly see the same triangle: only where it changes is anything looked up.
  std::vector<std::vector<std::pair<int, glm::uvec2>>> rows(size_t(count.y));
  tbb::parallel_for(0, count.y, [&](int row) {
    std::vector<int> materials;
    for (int column = 0; column < count.x; ++column) {
      materials.clear();
      glm::uvec2 last(VisibleTriangles::nothing, VisibleTriangles::no_ray);
      for (int y = row * side; y < std::min((row + 1) * side, height); ++y) {
        const glm::uvec2* hits = row_of(y);
        for (int x = column * side; x < std::min((column + 1) * side, width); ++x) {
          if (hits[x] == last) continue;
          if (hits[x].x != VisibleTriangles::nothing) see(hits[x].x);
          if (hits[x].y != last.y && hits[x].y != VisibleTriangles::no_ray) {
            materials.push_back(material_of(hits[x].y));
          }
          last = hits[x];
        }
      }
      std::sort(materials.begin(), materials.end());
      materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
      for (int material : materials) rows[size_t(row)].emplace_back(material, glm::uvec2(column, row));
    }
  });
  squares_.clear();
  for (const auto& row : rows) {
    for (const auto& [material, square] : row) squares_[material].push_back(square);
  }

  triangles_.clear();
  uint32_t instance = 0;
  for (uint32_t id = 0; id < seen_.size(); ++id) {
    if (!seen_[id].load(std::memory_order_relaxed)) continue;
    seen_[id].store(false, std::memory_order_relaxed);
    while (instance + 1 < scene_.instances.size() && scene_.instances[instance + 1].first_triangle <= id) ++instance;
    place_[id] = uint32_t(triangles_.size());
    triangles_.emplace_back(id, instance);
  }

  tbb::parallel_for(0, height, [&](int y) {
    const glm::uvec2* hits = row_of(y);
    uint32_t* out = places.data() + size_t(y) * size_t(width);
    uint32_t last = VisibleTriangles::nothing, place = VisibleTriangles::nothing;
    for (int x = 0; x < width; ++x) {
      if (hits[x].x != last) {
        last = hits[x].x;
        place = last == VisibleTriangles::nothing ? VisibleTriangles::nothing : place_[last];
      }
      out[x] = place;
    }
  });
}

}  // namespace omma
