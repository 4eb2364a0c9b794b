#include <gtest/gtest.h>

#include <map>
#include <random>

#include "omma/technique/sample_fragments.h"

namespace omma {
namespace {

using Hit = std::pair<uint32_t, uint32_t>;

/// Few triangles, the background and no ray, in runs as pictures have them.
std::vector<VisibleTriangles> random_samples(size_t count, ImageSize size, std::mt19937& random) {
  std::vector<VisibleTriangles> samples;
  std::uniform_int_distribution<int> kind(0, 6), run(0, 9);
  for (size_t s = 0; s < count; ++s) {
    VisibleTriangles& sample = samples.emplace_back(VisibleTriangles{size, {}});
    glm::uvec2 hit(VisibleTriangles::nothing);
    while (sample.hits.size() < size_t(size.width) * size_t(size.height)) {
      if (run(random) < 3) {
        const int what = kind(random);
        hit = what == 0   ? glm::uvec2(VisibleTriangles::nothing, VisibleTriangles::no_ray)
              : what == 1 ? glm::uvec2(VisibleTriangles::nothing)
                          : glm::uvec2(what, what / 3);
      }
      sample.hits.push_back(hit);
    }
  }
  return samples;
}

TEST(SampleFragments, HoldEverySampleWithARayOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-0.5, 0.5);
  const ImageSize size{37, 23};
  size_t several = 0;
  SampleFragments fragments;
  for (size_t count = 2; count <= SampleFragments::most_samples; ++count) {
    std::vector<glm::dvec2> shifts;
    for (size_t s = 0; s < count; ++s) shifts.emplace_back(within(random), within(random));
    const std::vector<VisibleTriangles> samples = random_samples(count, size, random);
    fragments.clear();
    for (VisibleTriangles sample : samples) fragments.add(sample);
    fragments.finish(shifts);
    size_t next = 0;
    for (int i = 0; i < size.width * size.height; ++i) {
      std::map<Hit, std::vector<size_t>> seen;
      for (size_t s = 0; s < count; ++s) {
        const glm::uvec2 hit = samples[s].hits[size_t(i)];
        if (hit.y != VisibleTriangles::no_ray) seen[{hit.x, hit.y}].push_back(s);
      }
      const auto take = [&](glm::uvec2 hit, SampleCoverage coverage) {
        const auto found = seen.find({hit.x, hit.y});
        ASSERT_NE(found, seen.end());
        EXPECT_EQ(found->second.size(), coverage.count);
        glm::dvec2 middle(0.0);
        for (size_t s : found->second) middle += shifts[s] / double(found->second.size());
        const glm::dvec2 shaded_at = glm::dvec2(coverage.x, coverage.y) / SampleCoverage::steps;
        EXPECT_LE(glm::distance(shaded_at, middle), 0.75 / SampleCoverage::steps);
        seen.erase(found);
      };
      if (seen.empty()) {
        EXPECT_EQ(fragments.first_coverage()[size_t(i)].count, 0);
        EXPECT_EQ(fragments.first().hits[size_t(i)].x, VisibleTriangles::nothing);
        continue;
      }
      take(fragments.first().hits[size_t(i)], fragments.first_coverage()[size_t(i)]);
      several += !seen.empty();
      while (!seen.empty()) {
        ASSERT_LT(next, fragments.further().size());
        const SampleFragments::Fragment& fragment = fragments.further()[next++];
        ASSERT_EQ(fragment.pixel, glm::u16vec2(i % size.width, i / size.width));
        take(fragment.hit, fragment.coverage);
      }
    }
    EXPECT_EQ(next, fragments.further().size());
  }
  EXPECT_GT(several, 1000u);
}

}  // namespace
}  // namespace omma
