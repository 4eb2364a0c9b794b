// What the city is made of: one mesh a material for each group of blocks.
#pragma once

#include <array>

#include "omma/scene/builtin/mesh_builder.h"
#include "omma/scene/builtin/random.h"

namespace omma::builtin {

enum class CityMaterial {
  road,
  asphalt,
  crossing,
  pavement,
  grass,
  brick,
  plaster,
  glass,
  concrete,
  roof,
  shopfront,
  bark,
  leaves,
  metal,
  count
};

/// The meshes of neighbouring blocks, indexed by material.
struct CityGroup {
  std::array<Mesh, static_cast<size_t>(CityMaterial::count)> meshes;
  Mesh& operator[](CityMaterial material) { return meshes[static_cast<size_t>(material)]; }
};

/// Everything on a block: `frame` is its front left corner at street height, `side` its length in metres.
void build_block(CityGroup& group, Random& random, const Frame& frame, float side);

}  // namespace omma::builtin
