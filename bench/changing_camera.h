// Frames whose camera is another one each time, against frames of one that stands still.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

nlohmann::json run_changing_camera(const Options& options);

}  // namespace omma::bench
