// What a fisheye picture costs by cube map, by its variants, and by the oracle, against a planar picture.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_image_based(const Options& options);

}  // namespace omma::bench
