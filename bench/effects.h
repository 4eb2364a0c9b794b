// How evenly line effects come out over the image: Lorenz and Döllner 2009, figure 8, as numbers.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_effects(const Options& options);

}  // namespace omma::bench
