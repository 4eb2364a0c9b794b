// Table 1 of Lorenz and Döllner 2009, and how piecewise perspective projections grow.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_piecewise(const Options& options);

}  // namespace omma::bench
