// Whole frames of visibility against those of every other technique, and of Embree with shading written by hand.
#pragma once

#include "bench/bench.h"

namespace omma::bench {

/// In the built-in scenes, in one whose vertices move with every frame, and in `options.scene`, if there is one.
nlohmann::json run_visibility_frames(const Options& options);

}  // namespace omma::bench
