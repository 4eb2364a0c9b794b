#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "omma/software/shade_fragments.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE
#include <hwy/foreach_target.h>
// Highway wants its own headers after foreach_target.h.
#include <hwy/highway.h>

#include "omma/software/shade_block-inl.h"
#include "omma/software/shade_fragments.h"

#if HWY_ONCE
namespace omma {

HWY_EXPORT(shade_fragments);

void shade_fragments(const ShadedScene& scene, const RayBlock& block, const SquareBorder& border,
                     Fragments& fragments) {
  HWY_DYNAMIC_DISPATCH(shade_fragments)(scene, block, border, fragments);
}

}  // namespace omma
#endif
