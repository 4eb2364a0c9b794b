#include "omma/technique/visibility/gpu_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "omma/base/error.h"

namespace omma {

GpuRays::GpuRays(const RayTree& rays, const gl::Limits& limits) : size_(rays.size()), blocks_(rays.blocks().size()) {
  // What is found for each ray is at most eight bytes in a storage block.
  const size_t most = std::min(size_t(limits.buffer_texels), limits.storage_bytes / sizeof(uint64_t));
  if (ray_count() > most) {
    throw MachineError("the rays of an image of {} x {} pixels do not fit into this driver's buffers of {}; set a tile",
                       size_.width, size_.height, most);
  }
  const ConeLevels cones(rays);
  levels_ = cones.levels;
  if (blocks_.empty()) return;
  directions_.reserve(ray_count() * sizeof(glm::vec3));
  masks_.reserve(blocks_.size() * sizeof(Block::rays));
  cones_.reserve(cones.cones.size() * sizeof(glm::vec4));
  const gl::WriteMapping<glm::vec3> directions(directions_.buffer(), ray_count());
  const gl::WriteMapping<uint16_t> masks(masks_.buffer(), blocks_.size() * RayBlock::leaves);
  const gl::WriteMapping<glm::vec4> nodes(cones_.buffer(), cones.cones.size());
  tbb::parallel_for(size_t{0}, blocks_.size(), [&](size_t b) {
    const RayBlock& block = rays.blocks()[b];
    blocks_[b].corner = {block.pixel_x, block.pixel_y};
    for (size_t leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      blocks_[b].rays[leaf] = masks.values()[b * RayBlock::leaves + leaf] = block.rays[leaf];
      for (size_t ray = 0; ray < 16; ++ray) {
        directions.values()[(b * RayBlock::leaves + leaf) * 16 + ray] = {block.x[leaf][ray], block.y[leaf][ray],
                                                                         block.z[leaf][ray]};
      }
    }
  });
  std::transform(cones.cones.begin(), cones.cones.end(), nodes.values().begin(),
                 [](const Cone& cone) { return glm::vec4(cone.axis, cone.sin); });
}

void GpuRays::bind() const {
  directions_.bind(10);
  masks_.bind(12);
  cones_.bind(16);
}

size_t GpuRays::pixel_of(uint32_t number) const {
  const Block& block = blocks_[number / 256];
  const int leaf = int(number % 256 / 16), ray = int(number % 16);
  const size_t x = size_t(block.corner.x + RayBlock::x_of(leaf, ray));
  const size_t y = size_t(block.corner.y + RayBlock::y_of(leaf, ray));
  return y * size_t(size_.width) + x;
}

}  // namespace omma
