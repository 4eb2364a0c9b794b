#include "bench/frame.h"

#include <fmt/core.h>

namespace omma::bench {

double megapixels_seen(const Camera& camera) {
  size_t seen = 0;
  const ImageSize size = camera.size();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) seen += camera.unproject({x + 0.5, y + 0.5}).has_value();
  }
  return double(seen) * 1e-6;
}

double frame_ms(const RenderStats& stats) {
  double sum = 0.0;
  for (const auto& [stage, ms] : stats.stage_ms) {
    if (stage != "read back") sum += ms;
  }
  return sum;
}

std::string stages_text(const RenderStats& stats) {
  std::string stages;
  for (const auto& [stage, ms] : stats.stage_ms) {
    if (stage != "read back") stages += fmt::format("{}{} {:.1f}", stages.empty() ? "" : ", ", stage, ms);
  }
  return stages;
}

const char* filter_name(Filter filter) { return filter == Filter::anisotropic ? "16x anisotropic" : "trilinear"; }

}  // namespace omma::bench
