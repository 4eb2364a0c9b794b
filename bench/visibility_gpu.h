// Finding the visible triangles by compute shaders, against the same on the processor.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

/// An empty list where there is no OpenGL.
nlohmann::json run_visibility_gpu(const Options& options);

}  // namespace omma::bench
