#include "omma/software/shade_fragments.h"

#include "simd_targets.h"

namespace omma {

#define OMMA_DECLARE(name)                         \
  namespace name {                                 \
  decltype(omma::shade_fragments) shade_fragments; \
  }
OMMA_SIMD_TARGETS(OMMA_DECLARE)
#undef OMMA_DECLARE

HWY_EXPORT(shade_fragments);

void shade_fragments(const ShadedScene& scene, const RayBlock& block, const SquareBorder& border,
                     Fragments& fragments) {
  HWY_DYNAMIC_DISPATCH(shade_fragments)(scene, block, border, fragments);
}

}  // namespace omma
