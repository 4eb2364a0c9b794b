// What several samples of each pixel see, every triangle once: the fragments of an A-buffer (Carpenter 1984).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/technique/visible_squares.h"

namespace omma {

/// How many of a pixel's samples see a triangle, or the background, and where it is shaded: in their middle, in steps
/// from the pixel's centre. One of the samples instead would move the picture.
struct SampleCoverage {
  static constexpr double steps = 256.0;  ///< in a pixel
  int8_t count = 0, x = 0, y = 0;
  int8_t unused = 0;  ///< a texel has two components or four
};

/// One sample of every pixel is added after the other: what most samples see is kept once. Runs on all cores; the
/// result depends on the samples alone.
class SampleFragments {
 public:
  static constexpr size_t most_samples = 16;

  struct Fragment {
    glm::u16vec2 pixel;
    SampleCoverage coverage;
    glm::uvec2 hit;  ///< as in VisibleTriangles
  };

  /// Forgets all samples.
  void clear() { count_ = 0; }
  size_t count() const { return count_; }
  /// What the next sample sees, of the size that the others have; not every pixel needs a ray. What `sample` holds
  /// afterwards is of no meaning.
  void add(VisibleTriangles& sample);
  /// Once all are there, two or more, at `shifts` from the pixels' centres. `first` alone needs no finish.
  void finish(std::span<const glm::dvec2> shifts);

  /// Of every pixel; what its first sample with a ray sees.
  const VisibleTriangles& first() const { return first_; }
  /// By pixel; none where no sample has a ray.
  const std::vector<SampleCoverage>& first_coverage() const { return first_coverage_; }
  /// Whatever else a pixel sees; rows from the top, pixels from the left.
  const std::vector<Fragment>& further() const { return further_; }

  size_t bytes() const;

 private:
  using SampleSet = uint16_t;
  /// What a pixel sees beside its first hit, and the next of the kind in its row's list; 0 is none.
  struct Link {
    glm::uvec2 hit;
    SampleSet set;
    uint32_t next;
  };
  void add_to_row(size_t y, const glm::uvec2* hits);

  size_t count_ = 0;
  VisibleTriangles first_;
  std::vector<SampleSet> first_set_;
  std::vector<uint32_t> links_;          ///< by pixel: the first of its links, plus one
  std::vector<std::vector<Link>> rows_;  ///< of pixels
  std::vector<SampleCoverage> first_coverage_;
  std::vector<Fragment> further_;
};

}  // namespace omma
