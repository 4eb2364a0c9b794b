#include "omma/technique/sample_fragments.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <limits>

namespace omma {
namespace {

/// Of a set of samples, the one nearest to their middle.
uint8_t middle_sample(uint32_t set, std::span<const glm::dvec2> shifts) {
  glm::dvec2 middle(0.0);
  for (uint32_t rest = set; rest != 0; rest &= rest - 1) middle += shifts[size_t(std::countr_zero(rest))];
  middle /= double(std::popcount(set));
  uint8_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t rest = set; rest != 0; rest &= rest - 1) {
    const auto sample = uint8_t(std::countr_zero(rest));
    const glm::dvec2 offset = shifts[sample] - middle;
    if (const double distance = glm::dot(offset, offset); distance < least) {
      least = distance;
      nearest = sample;
    }
  }
  return nearest;
}

}  // namespace

SampleFragments::SampleFragments(std::vector<VisibleTriangles> samples, std::span<const glm::dvec2> shifts) {
  const auto count = uint32_t(samples.size());
  first = std::move(samples.front());
  const size_t width = size_t(first.size.width), height = size_t(first.size.height);
  first_coverage.resize(first.hits.size());
  const uint32_t all = (1u << count) - 1;
  const SampleCoverage whole{uint8_t(count), middle_sample(all, shifts)};

  std::vector<std::vector<Fragment>> rows(height);
  tbb::parallel_for(size_t{0}, height, [&](size_t y) {
    glm::uvec2* const firsts = first.hits.data() + y * width;
    SampleCoverage* const coverage = first_coverage.data() + y * width;
    // Most pixels see one triangle; sample by sample that is soon known.
    std::vector<uint8_t> differs(width, 0);
    for (uint32_t s = 1; s < count; ++s) {
      const glm::uvec2* others = samples[s].hits.data() + y * width;
      for (size_t x = 0; x < width; ++x) {
        differs[x] |= uint8_t((firsts[x].x != others[x].x) | (firsts[x].y != others[x].y));
      }
    }
    for (size_t x = 0; x < width; ++x) {
      if (!differs[x]) {
        if (firsts[x].y != VisibleTriangles::no_ray) coverage[x] = whole;
        continue;
      }
      const glm::uvec2 of_first_sample = firsts[x];
      const auto hit_of = [&](uint32_t s) { return s == 0 ? of_first_sample : samples[s].hits[y * width + x]; };
      for (uint32_t rest = all; rest != 0;) {
        const glm::uvec2 hit = hit_of(uint32_t(std::countr_zero(rest)));
        uint32_t set = 0;
        for (uint32_t others = rest; others != 0; others &= others - 1) {
          const auto s = uint32_t(std::countr_zero(others));
          if (hit_of(s) == hit) set |= 1u << s;
        }
        rest &= ~set;
        if (hit.y == VisibleTriangles::no_ray) continue;
        const SampleCoverage seen{uint8_t(std::popcount(set)), middle_sample(set, shifts)};
        if (coverage[x].count == 0) {
          firsts[x] = hit;
          coverage[x] = seen;
        } else {
          rows[y].push_back({glm::u16vec2(x, y), seen, hit});
        }
      }
    }
  });
  size_t sum = 0;
  for (const auto& row : rows) sum += row.size();
  further.reserve(sum);
  for (const auto& row : rows) further.insert(further.end(), row.begin(), row.end());
}

}  // namespace omma
