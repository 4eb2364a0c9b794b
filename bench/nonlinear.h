// Tables 2 and 3 of Gascuel et al. 2008: non-linear projections against cubes and hemicubes, and where their time goes.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_nonlinear(const Options& options);

}  // namespace omma::bench
