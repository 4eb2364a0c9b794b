// Finding the visible triangles: the cone tree against Embree on the same triangles and rays; and whole frames.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_visibility(const Options& options);

}  // namespace omma::bench
