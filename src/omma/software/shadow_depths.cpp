#include "omma/software/shadow_depths.h"

namespace omma {
namespace {

/// The depths of a block's rays, at its place in a map of `size` texels a side.
void write(const RayBlock& block, const BlockPicture& picture, bool flat, int size, float* depths) {
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      if ((block.rays[leaf] >> ray & 1) == 0) continue;
      const int x = block.pixel_x + RayBlock::x_of(leaf, ray);
      const int y = block.pixel_y + RayBlock::y_of(leaf, ray);
      const float ahead = flat ? -block.z[leaf][ray] : 1.0f;
      depths[size_t(y) * size_t(size) + size_t(x)] = ShadowDepths::near * picture.inverse_distance[leaf][ray] / ahead;
    }
  }
}

}  // namespace

ShadowDepths::ShadowDepths(const SceneIndex& index, Shadows kind, int size, RecentRays& rays)
    : size_(size),
      layers_(plan_shadow_layers(lights_of(index.scene()), boxes_of_triangles(index.scene()), kind, size)) {
  const size_t texels = size_t(size) * size_t(size);
  depths_.assign(layers_.size() * texels, 0.0f);
  for (size_t i = 0; i < layers_.size(); ++i) {
    const ShadowLayer& layer = layers_[i];
    const Finder finder(index, layer.worldFromMap);
    const std::shared_ptr<const RaySource> of_layer = rays.of(layer.camera, {glm::dvec2(0.0)});
    finder.each_block(*of_layer, Solid::labels, [&](const RayBlock& block, const BlockPicture& picture) {
      write(block, picture, layer.flat(), size, &depths_[i * texels]);
    });
  }
}

}  // namespace omma
