#include "omma/visibility/make_blocks.h"

#include "simd_targets.h"

namespace omma {

#define OMMA_DECLARE(name)                   \
  namespace name {                           \
  decltype(omma::make_blocks) make_blocks;   \
  decltype(omma::finish_block) finish_block; \
  }
OMMA_SIMD_TARGETS(OMMA_DECLARE)
#undef OMMA_DECLARE

HWY_EXPORT(make_blocks);
HWY_EXPORT(finish_block);

void make_blocks(const PatchSquare& square, std::span<RayBlock> blocks, SquareBorder& border) {
  HWY_DYNAMIC_DISPATCH(make_blocks)(square, blocks, border);
}

bool finish_block(RayBlock& block) { return HWY_DYNAMIC_DISPATCH(finish_block)(block); }

}  // namespace omma
