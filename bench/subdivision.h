// The general pinhole camera's comparison of its feed-forward methods: triangles bounded, split, or their vertices
// projected alone.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_subdivision(const Options& options);

}  // namespace omma::bench
