#include "omma/software/surroundings.h"

#include "omma/software/box_filter.h"

namespace omma {

Surroundings::Surroundings(const ReflectionLayers& layers, const std::array<FloatImage, 2>& maps)
    : size(layers.camera.size().width), levels(layers.levels), focal(float(layers.camera.lens()->focal.x)) {
  for (size_t side = 0; side < maps.size(); ++side) {
    std::vector<float>& to = texels[side];
    to = maps[side].values;
    std::vector<glm::vec4> level;
    for (size_t i = 0; i < to.size(); i += 3) level.emplace_back(to[i], to[i + 1], to[i + 2], 0.0f);
    glm::ivec2 extent(size);
    for (int l = 1; l < levels; ++l) {
      level = next_level(level, extent);
      extent = next_size(extent);
      first[size_t(l)] = int32_t(to.size() / 3);
      for (const glm::vec4& value : level) to.insert(to.end(), {value.r, value.g, value.b});
    }
  }
}

}  // namespace omma
