// What surrounds an object that reflects: the two maps of shading/reflection_layers.h with their smaller levels, as the
// processor samples them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "omma/image/image.h"
#include "omma/shading/reflection_layers.h"

namespace omma {

struct Surroundings {
  static constexpr int most_size = 1 << 13;  ///< so that all texels can be counted in 32 bits
  static constexpr int most_levels = 16;

  /// `maps`: linear RGB, what either camera of `layers` sees.
  Surroundings(const ReflectionLayers& layers, const std::array<FloatImage, 2>& maps);

  int size, levels;
  float focal;                               ///< texels of the finest level
  std::array<int32_t, most_levels> first{};  ///< a level's first texel; it has size >> level along a side
  std::array<std::vector<float>, 2> texels;  ///< RGB, by map; rows from the top

  size_t bytes() const { return (texels[0].size() + texels[1].size()) * sizeof(float); }
};

}  // namespace omma
