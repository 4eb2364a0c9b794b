#include "omma/software/fragments.h"

#include <algorithm>
#include <cstring>

namespace omma {
namespace {

constexpr size_t lanes = 16;
/// Cosine between the rays of a pixel's samples; where they look farther apart, a camera jumps.
constexpr float least_along = 0.9f;

}  // namespace

Fragments::Fragments(std::span<const RecordInstance> instances) : instances_(instances) {
  for (const RecordInstance& instance : instances) has_colors_ |= !instance.mesh->colors.empty();
}

void Fragments::collect(std::span<const FoundBlock> samples) {
  samples_ = samples.size();
  // Each fragment may be another triangle's.
  size_t most = samples_ * pixels;
  for (const FoundBlock& sample : samples) most += sample.layers.size();
  size_t slots = 512;
  while (slots < 2 * most) slots *= 2;
  if (table_.size() < slots) table_.assign(slots, Slot{});
  ++square_;
  groups_.clear();
  records_.clear();
  seen_.clear();
  layered_.clear();
  layer_.clear();

  compare_samples(samples);
  const BlockPicture& first = samples.front().picture;
  bool some_mixed = false;
  // Neighbours mostly see the same triangle.
  uint32_t last_triangle = 0;
  Kind last;
  for (int i = 0; i < pixels; ++i) {
    const uint32_t triangle = first.triangle[i / 16][i % 16], instance = first.instance[i / 16][i % 16];
    some_mixed |= mixed_[i] != 0;
    kind_[i] = {};
    if (mixed_[i] != 0 || instance == no_ray) continue;
    if (triangle != last_triangle || last.group == no_fragment) last = kind_of(triangle, instance);
    last_triangle = triangle;
    kind_[i] = last;
    ++groups_[last.group].count;
  }
  if (some_mixed) {
    std::fill_n(first_seen_, pixels, -1);
    for (const FoundBlock& sample : samples) collect_mixed(sample);
    for (const Seen& seen : seen_) ++groups_[seen.kind.group].count;
  }
  place();
}

/// Which pixels are mixed, and where those look that are not.
void Fragments::compare_samples(std::span<const FoundBlock> samples) {
  std::fill_n(mixed_, pixels, 0u);
  std::fill_n(is_layered_, pixels, false);
  const FoundBlock& first = samples.front();
  std::memcpy(direction_[0], first.block->x, sizeof direction_[0]);
  std::memcpy(direction_[1], first.block->y, sizeof direction_[1]);
  std::memcpy(direction_[2], first.block->z, sizeof direction_[2]);
  for (const FoundBlock& sample : samples) {
    for (const BlockLayer& layer : sample.layers) {
      const size_t at = layer.leaf * 16 + layer.ray;
      is_layered_[at] = true;
      mixed_[at] = 1;
    }
    if (&sample == &first) continue;
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      for (int ray = 0; ray < 16; ++ray) {
        const int i = 16 * leaf + ray;
        const float along = sample.block->x[leaf][ray] * first.block->x[leaf][ray] +
                            sample.block->y[leaf][ray] * first.block->y[leaf][ray] +
                            sample.block->z[leaf][ray] * first.block->z[leaf][ray];
        mixed_[i] |= (sample.picture.triangle[leaf][ray] ^ first.picture.triangle[leaf][ray]) |
                     (sample.picture.instance[leaf][ray] ^ first.picture.instance[leaf][ray]) |
                     uint32_t(along < least_along);
        direction_[0][i] += sample.block->x[leaf][ray];
        direction_[1][i] += sample.block->y[leaf][ray];
        direction_[2][i] += sample.block->z[leaf][ray];
      }
    }
  }
  if (samples.size() == 1) return;
  const float share = 1.0f / float(samples.size());
  for (auto& component : direction_) {
    for (float& value : component) value *= share;
  }
}

void Fragments::collect_mixed(const FoundBlock& sample) {
  std::vector<BlockLayer> sorted(sample.layers);
  std::sort(sorted.begin(), sorted.end(), [](const BlockLayer& a, const BlockLayer& b) {
    if (a.leaf != b.leaf) return a.leaf < b.leaf;
    if (a.ray != b.ray) return a.ray < b.ray;
    return a.hit.distance != b.hit.distance ? a.hit.distance < b.hit.distance : a.hit.triangle < b.hit.triangle;
  });
  auto next = sorted.cbegin();
  const RayBlock& block = *sample.block;
  for (int i = 0; i < pixels; ++i) {
    const int leaf = i / 16, ray = i % 16;
    const uint32_t instance = sample.picture.instance[leaf][ray];
    if (mixed_[i] == 0 || instance == no_ray) continue;
    const glm::vec3 direction(block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]);
    const int opaque = seen_of(i, sample.picture.triangle[leaf][ray], instance, direction);
    if (!is_layered_[i]) continue;
    Layers layers{i, opaque, uint32_t(layer_.size()), 0};
    for (; next != sorted.cend() && int(next->leaf) == leaf && int(next->ray) == ray; ++next, ++layers.count) {
      layer_.push_back(seen_of(i, next->hit.triangle, next->hit.instance, direction));
    }
    layered_.push_back(layers);
  }
}

int Fragments::seen_of(int at, uint32_t triangle, uint32_t instance, const glm::vec3& direction) {
  for (int i = first_seen_[at]; i >= 0; i = seen_[size_t(i)].next) {
    Seen& seen = seen_[size_t(i)];
    if (seen.triangle != triangle || glm::dot(seen.direction, direction) < least_along * seen.samples) continue;
    seen.direction += direction;
    seen.samples += 1.0f;
    return i;
  }
  seen_.push_back({triangle, kind_of(triangle, instance), at, 1.0f, direction, first_seen_[at], no_fragment});
  return first_seen_[at] = int(seen_.size()) - 1;
}

Fragments::Kind Fragments::kind_of(uint32_t triangle, uint32_t instance) {
  const bool is_background = triangle == meets_nothing;
  const int material = is_background ? background_material : instances_[instance].material;
  const bool reflects = !is_background && instances_[instance].reflects;
  size_t group = 0;
  while (group < groups_.size() && (groups_[group].material != material || groups_[group].reflects != reflects)) {
    ++group;
  }
  if (group == groups_.size()) groups_.push_back({material, reflects, 0, 0});
  return {uint32_t(group), is_background ? 0 : record_of(triangle, instance)};
}

uint32_t Fragments::record_of(uint32_t triangle, uint32_t instance) {
  // An odd multiplier spreads what differs in few bits; the upper ones are spread best.
  const size_t mask = table_.size() - 1;
  size_t at = (triangle * 2654435769u >> 12) & mask;
  for (; table_[at].square == square_; at = (at + 1) & mask) {
    if (table_[at].triangle == triangle) return table_[at].record;
  }
  table_[at] = {triangle, uint32_t(records_.size()), square_};
  records_.push_back(triangle_record(instances_[instance], triangle));
  return table_[at].record;
}

/// Gives every fragment its place, those of a material next to each other.
void Fragments::place() {
  const bool is_whole = groups_.size() == 1 && groups_.front().count == pixels && seen_.empty();
  uint32_t end = 0;
  for (FragmentGroup& group : groups_) {
    group.first = end;
    end += uint32_t((group.count + lanes - 1) / lanes * lanes);
    if (group.material != background_material) surfaces_ += group.count;
    group.count = 0;
  }
  if (x.size() < end) {
    for (std::vector<float>* values : {&x, &y, &z, &red, &green, &blue, &coverage}) values->resize(end);
    record.resize(end);
    pixel.resize(end);
  }
  if (is_whole) {
    // One material all over.
    std::memcpy(x.data(), direction_[0], sizeof direction_[0]);
    std::memcpy(y.data(), direction_[1], sizeof direction_[1]);
    std::memcpy(z.data(), direction_[2], sizeof direction_[2]);
    for (int i = 0; i < pixels; ++i) {
      pixel[size_t(i)] = i;
      record[size_t(i)] = kind_[i].record;
      place_[i] = uint32_t(i);
    }
    groups_.front().count = pixels;
    return;
  }
  for (int i = 0; i < pixels; ++i) {
    place_[i] = no_fragment;
    if (kind_[i].group == no_fragment) continue;
    place_[i] = put(kind_[i], i, {direction_[0][i], direction_[1][i], direction_[2][i]});
  }
  for (Seen& seen : seen_) seen.place = put(seen.kind, seen.pixel, seen.direction / seen.samples);
  for (const FragmentGroup& group : groups_) {
    const uint32_t last = group.first + group.count - 1;
    for (uint32_t i = last + 1; i % lanes != 0; ++i) {
      x[i] = x[last];
      y[i] = y[last];
      z[i] = z[last];
      pixel[i] = pixel[last];
      record[i] = record[last];
    }
  }
}

uint32_t Fragments::put(const Kind& kind, int at, const glm::vec3& direction) {
  FragmentGroup& group = groups_[kind.group];
  const uint32_t to = group.first + group.count++;
  x[to] = direction.x;
  y[to] = direction.y;
  z[to] = direction.z;
  pixel[to] = at;
  record[to] = kind.record;
  return to;
}

void Fragments::resolve(float share, bool is_first, const ColorRows& to, glm::ivec2 corner) const {
  glm::vec3 sum[pixels];
  const auto color = [&](uint32_t at) { return glm::vec3(red[at], green[at], blue[at]); };
  for (int i = 0; i < pixels; ++i) sum[i] = place_[i] == no_fragment ? glm::vec3(0.0f) : share * color(place_[i]);
  const float of_sample = share / float(samples_);
  for (const Seen& seen : seen_) {
    if (!is_layered_[seen.pixel]) sum[seen.pixel] += seen.samples * of_sample * color(seen.place);
  }
  for (const Layers& layers : layered_) {
    glm::vec3 behind = color(seen_[size_t(layers.opaque)].place);
    for (uint32_t i = layers.first + layers.count; i-- > layers.first;) {
      const uint32_t at = seen_[size_t(layer_[i])].place;
      behind = glm::mix(behind, color(at), coverage[at]);
    }
    sum[layers.pixel] += of_sample * behind;
  }
  to.put(sum, is_first, corner);
}

}  // namespace omma
