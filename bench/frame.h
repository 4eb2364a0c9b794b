// A picture as benchmarks measure it.
#pragma once

#include <string>

#include "omma/camera/camera.h"
#include "omma/render/prepared_scene.h"

namespace omma::bench {

/// Millions of pixels that have a ray: a picture outside its image circle costs nothing.
double megapixels_seen(const Camera& camera);

/// Milliseconds without the copy back to main memory, which a picture for a screen does not need.
double frame_ms(const RenderStats& stats);

/// The stages of a frame with their milliseconds, "faces 41.4, resample 25.6".
std::string stages_text(const RenderStats& stats);

const char* filter_name(Filter filter);

}  // namespace omma::bench
