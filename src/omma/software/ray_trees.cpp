#include "omma/software/ray_trees.h"

#include <cmath>

#include "omma/camera/ray_bundle.h"

namespace omma {
namespace {

/// Rays and their tree take some 26 bytes a ray; so many are found at once, and twice as many kept for the next
/// picture.
constexpr size_t most_rays = size_t{1} << 25;

}  // namespace

int RayTrees::good_tile(size_t samples) {
  const int side = int(std::sqrt(double(most_rays / samples)));
  return side / RayBlock::side * RayBlock::side;
}

const RayTree& RayTrees::of_tile(const Camera& camera, const PixelRect& tile, const std::vector<glm::dvec2>& shifts) {
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    if (entry->tile != tile || entry->shifts != shifts || entry->camera != camera) continue;
    entries_.splice(entries_.end(), entries_, entry);
    return entry->tree;
  }
  size_t kept = size_t(tile.width()) * size_t(tile.height()) * shifts.size();
  for (const Entry& entry : entries_) kept += entry.rays();
  for (; !entries_.empty() && kept > 2 * most_rays; entries_.pop_front()) kept -= entries_.front().rays();
  std::vector<RayMap> samples;
  for (const glm::dvec2& shift : shifts) samples.push_back(rays_of(camera, tile, shift));
  return entries_.emplace_back(Entry{camera, tile, shifts, RayTree(samples)}).tree;
}

size_t RayTrees::bytes() const {
  size_t bytes = 0;
  for (const Entry& entry : entries_) bytes += entry.tree.bytes();
  return bytes;
}

}  // namespace omma
