// What several samples of each pixel see, every triangle once: the fragments of an A-buffer (Carpenter 1984).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/technique/visible_squares.h"

namespace omma {

/// How many of a pixel's samples see a triangle, or the background, and at which of them it is shaded: the one nearest
/// to their middle. The middle itself may lie beside the triangle, where edges are curved and where a camera jumps.
struct SampleCoverage {
  uint8_t count = 0, sample = 0;
};

struct SampleFragments {
  static constexpr size_t most_samples = 16;

  struct Fragment {
    glm::u16vec2 pixel;
    SampleCoverage coverage;
    glm::uvec2 hit;  ///< as in VisibleTriangles
  };

  /// From what each sample sees, at `shifts` from the pixels' centres. As many samples as shifts, one to most_samples;
  /// none of them needs a ray. Runs on all cores; the result depends on the samples alone.
  SampleFragments(std::vector<VisibleTriangles> samples, std::span<const glm::dvec2> shifts);

  VisibleTriangles first;                      ///< of every pixel; what its first sample with a ray sees
  std::vector<SampleCoverage> first_coverage;  ///< by pixel; none where no sample has a ray
  std::vector<Fragment> further;               ///< whatever else a pixel sees; rows from the top, pixels from the left
};

}  // namespace omma
