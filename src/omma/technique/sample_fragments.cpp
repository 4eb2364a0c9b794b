#include "omma/technique/sample_fragments.h"

#include <tbb/parallel_for.h>

#include <bit>

namespace omma {
namespace {

/// Of a set of samples.
SampleCoverage coverage_of(uint32_t set, std::span<const glm::dvec2> shifts) {
  const int count = std::popcount(set);
  glm::dvec2 middle(0.0);
  for (uint32_t rest = set; rest != 0; rest &= rest - 1) middle += shifts[size_t(std::countr_zero(rest))];
  const glm::dvec2 steps = glm::clamp(glm::round(middle * (SampleCoverage::steps / double(count))), -128.0, 127.0);
  return {int8_t(count), int8_t(steps.x), int8_t(steps.y)};
}

}  // namespace

void SampleFragments::add(VisibleTriangles& sample) {
  if (count_ == 0) {
    std::swap(first_, sample);
  } else {
    if (count_ == 1) {
      first_set_.assign(first_.hits.size(), 1);
      links_.assign(first_.hits.size(), 0);
      rows_.resize(size_t(first_.size.height));
      for (auto& row : rows_) row.clear();
    }
    tbb::parallel_for(size_t{0}, rows_.size(),
                      [&](size_t y) { add_to_row(y, sample.hits.data() + y * size_t(sample.size.width)); });
  }
  ++count_;
}

void SampleFragments::add_to_row(size_t y, const glm::uvec2* hits) {
  const auto width = size_t(first_.size.width);
  const auto bit = SampleSet(1u << count_);
  glm::uvec2* const firsts = first_.hits.data() + y * width;
  SampleSet* const sets = first_set_.data() + y * width;
  std::vector<Link>& row = rows_[y];
  for (size_t x = 0; x < width; ++x) {
    if (hits[x] == firsts[x]) {
      sets[x] |= bit;
      continue;
    }
    if (hits[x].y == VisibleTriangles::no_ray) continue;
    if (firsts[x].y == VisibleTriangles::no_ray) {
      firsts[x] = hits[x];
      sets[x] = bit;
      continue;
    }
    uint32_t* at = &links_[y * width + x];
    while (*at != 0 && row[*at - 1].hit != hits[x]) at = &row[*at - 1].next;
    if (*at == 0) {
      *at = uint32_t(row.size() + 1);
      row.push_back({hits[x], 0, 0});
      row.back().set = bit;
    } else {
      row[*at - 1].set |= bit;
    }
  }
}

void SampleFragments::finish(std::span<const glm::dvec2> shifts) {
  const auto all = SampleSet((1u << count_) - 1);
  const SampleCoverage whole = coverage_of(all, shifts);
  const auto width = size_t(first_.size.width);
  first_coverage_.resize(first_set_.size());
  std::vector<size_t> places(rows_.size() + 1, 0);
  for (size_t y = 0; y < rows_.size(); ++y) places[y + 1] = places[y] + rows_[y].size();
  further_.resize(places.back());
  tbb::parallel_for(size_t{0}, rows_.size(), [&](size_t y) {
    Fragment* out = further_.data() + places[y];
    for (size_t i = y * width; i < (y + 1) * width; ++i) {
      const bool has_ray = first_.hits[i].y != VisibleTriangles::no_ray;
      first_coverage_[i] = !has_ray               ? SampleCoverage{}
                           : first_set_[i] == all ? whole
                                                  : coverage_of(first_set_[i], shifts);
      for (uint32_t at = links_[i]; at != 0; at = rows_[y][at - 1].next) {
        const Link& link = rows_[y][at - 1];
        *out++ = {glm::u16vec2(i - y * width, y), coverage_of(link.set, shifts), link.hit};
      }
    }
  });
}

size_t SampleFragments::bytes() const {
  size_t sum = first_.hits.capacity() * sizeof(glm::uvec2) + first_set_.capacity() * sizeof(SampleSet) +
               links_.capacity() * sizeof(uint32_t) + first_coverage_.capacity() * sizeof(SampleCoverage) +
               further_.capacity() * sizeof(Fragment);
  for (const auto& row : rows_) sum += row.capacity() * sizeof(Link);
  return sum;
}

}  // namespace omma
