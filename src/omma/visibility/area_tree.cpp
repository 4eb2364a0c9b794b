#include "omma/visibility/area_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace omma {
namespace {

using Part = AreaTree::Part;
/// A register, by an extension that compilers share; the fourth lane means nothing.
using Floats = float __attribute__((vector_size(16)));
using Ints = int32_t __attribute__((vector_size(16)));

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float gain = 0.5f;  ///< two leaves are better than one when their areas together are less than this share
constexpr int depth_by_area = 40;  ///< deeper down parts are halved, which bounds the tree's depth
constexpr uint32_t swept = 128;    ///< up to so many boxes every border is tried, beyond those between bins
constexpr size_t bins = 16;
constexpr uint32_t parallel_size = 4096;
constexpr uint32_t shared_size = 1u << 17;  ///< a part that all cores bin together

/// A box with its number, as it is moved to and fro.
struct alignas(32) Item {
  float min[3];
  uint32_t number;
  float max[3];
  uint32_t unused;
};

struct WideBox {
  Floats min = Floats{} + infinity, max = Floats{} - infinity;

  static WideBox of(const Item& item) {
    return {Floats{item.min[0], item.min[1], item.min[2], 0.0f}, Floats{item.max[0], item.max[1], item.max[2], 0.0f}};
  }
  void add(const WideBox& other) {
    min = other.min < min ? other.min : min;
    max = max < other.max ? other.max : max;
  }
  /// Twice the centre: halving gains nothing.
  Floats centre() const { return min + max; }
  float half_area() const { return box().half_area(); }
  Box box() const { return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}}; }
};

/// Of `count` boxes in leaves of `leaf_size`, but for a factor.
float cost(float half_area, uint32_t count, uint32_t leaf_size) {
  return half_area * float((count + leaf_size - 1) / leaf_size);
}

int longest_axis(const glm::vec3& extent) {
  return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
}

/// In whole leaves.
uint32_t half_of(uint32_t count, uint32_t leaf_size) { return (count / 2 + leaf_size - 1) / leaf_size * leaf_size; }

/// The tree over few boxes. They are sorted along each axis once; parts of them stay sorted.
class Sweeper {
 public:
  Sweeper(std::span<const Item> items, uint32_t leaf_size) : count_(uint32_t(items.size())), leaf_size_(leaf_size) {
    std::array<Floats, swept> centre;
    for (uint32_t i = 0; i < count_; ++i) {
      box_[i] = WideBox::of(items[i]);
      number_[i] = items[i].number;
      centre[i] = box_[i].centre();
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      // The order of the bits of positive floats is theirs; that of negative ones is turned round.
      std::array<uint64_t, swept> keys;
      for (uint32_t i = 0; i < count_; ++i) {
        const auto bits = std::bit_cast<uint32_t>(centre[i][axis] + 0.0f);
        keys[i] = uint64_t(bits & 0x80000000u ? ~bits : bits | 0x80000000u) << 32 | i;
      }
      std::sort(keys.begin(), keys.begin() + count_);
      for (uint32_t i = 0; i < count_; ++i) sorted_[axis][i] = uint8_t(keys[i]);
    }
  }

  /// Writes the boxes' numbers in the tree's order; they are what begins at `first_number` there.
  std::unique_ptr<Part> split(int depth, uint32_t first_number, uint32_t* numbers) {
    auto part = split(0, count_, depth, first_number);
    for (uint32_t i = 0; i < count_; ++i) numbers[i] = number_[sorted_[0][i]];
    return part;
  }

 private:
  std::unique_ptr<Part> split(uint32_t first, uint32_t count, int depth, uint32_t first_number) {
    auto part = std::make_unique<Part>();
    part->first = first_number + first;
    part->count = count;
    WideBox whole;
    for (uint32_t i = first; i < first + count; ++i) whole.add(box_[sorted_[0][i]]);
    part->box = whole.box();
    if (count == 1) return part;
    size_t axis = 0;
    uint32_t left = 0;
    if (count <= leaf_size_) {
      left = best_border(first, count, 1, gain * part->box.half_area(), axis);
      if (left == 0) return part;
    } else if (depth < depth_by_area) {
      left = best_border(first, count, leaf_size_, infinity, axis);
    }
    if (left == 0) {
      axis = size_t(longest_axis(part->box.max - part->box.min));
      left = half_of(count, leaf_size_);
    }
    partition(first, count, axis, left);
    part->left = split(first, left, depth + 1, first_number);
    part->right = split(first + left, count - left, depth + 1, first_number);
    return part;
  }

  /// Tries every `step`-th border; returns how many go to the left at the best that costs less than `least`, or 0.
  uint32_t best_border(uint32_t first, uint32_t count, uint32_t step, float least, size_t& best_axis) const {
    uint32_t best = 0;
    std::array<float, swept> right_cost;
    for (size_t axis = 0; axis < 3; ++axis) {
      const uint8_t* sorted = &sorted_[axis][first];
      WideBox right;
      for (uint32_t i = count; i-- > 1;) {
        right.add(box_[sorted[i]]);
        if (i % step == 0) right_cost[i] = cost(right.half_area(), count - i, leaf_size_);
      }
      WideBox left;
      for (uint32_t i = 1; i < count; ++i) {
        left.add(box_[sorted[i - 1]]);
        if (i % step != 0) continue;
        const float c = cost(left.half_area(), i, leaf_size_) + right_cost[i];
        if (c < least) {
          least = c;
          best_axis = axis;
          best = i;
        }
      }
    }
    return best;
  }

  void partition(uint32_t first, uint32_t count, size_t by, uint32_t left) {
    for (uint32_t i = 0; i < count; ++i) is_left_[sorted_[by][first + i]] = i < left;
    std::array<uint8_t, swept> others;
    for (size_t axis = 0; axis < 3; ++axis) {
      if (axis == by) continue;
      uint8_t* sorted = &sorted_[axis][first];
      uint32_t to_left = 0, to_right = 0;
      for (uint32_t i = 0; i < count; ++i) {
        const uint8_t box = sorted[i];
        sorted[to_left] = others[to_right] = box;
        to_left += is_left_[box];
        to_right += !is_left_[box];
      }
      std::copy_n(others.begin(), to_right, sorted + to_left);
    }
  }

  uint32_t count_, leaf_size_;
  std::array<WideBox, swept> box_;
  std::array<uint32_t, swept> number_;
  std::array<std::array<uint8_t, swept>, 3> sorted_;
  std::array<bool, swept> is_left_;
};

/// Calls `each` for the items and adds up what it made of them; on all cores where they are many.
template <typename Result, typename Each>
Result reduce(std::span<const Item> items, const Each& each) {
  const auto over = [&](std::span<const Item> some, Result result) {
    for (const Item& item : some) each(item, result);
    return result;
  };
  if (items.size() < shared_size) return over(items, {});
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, items.size(), parallel_size), Result{},
      [&](const auto& range, const Result& so_far) { return over(items.subspan(range.begin(), range.size()), so_far); },
      [](Result a, const Result& b) {
        a.add(b);
        return a;
      });
}

struct Extent {
  WideBox whole, centres;
  void add(const Extent& other) {
    whole.add(other.whole);
    centres.add(other.centres);
  }
};

/// Boxes by the place of their centres along each axis.
struct Bins {
  WideBox box[3][bins];
  uint32_t count[3][bins] = {};

  void add(const Bins& other) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (size_t b = 0; b < bins; ++b) {
        box[axis][b].add(other.box[axis][b]);
        count[axis][b] += other.count[axis][b];
      }
    }
  }
};

class BinOf {
 public:
  explicit BinOf(const WideBox& centres) : low_(centres.min), scale_(float(bins) / (centres.max - centres.min)) {}

  /// Along the three axes.
  Ints operator()(const WideBox& box) const {
    const Floats share = (box.centre() - low_) * scale_, none{}, last = none + float(bins - 1);
    const Floats not_less = none < share ? share : none;  // nor not a number
    return __builtin_convertvector(not_less < last ? not_less : last, Ints);
  }

 private:
  Floats low_, scale_;
};

class Builder {
 public:
  Builder(std::span<const Box> boxes, uint32_t leaf_size)
      : leaf_size_(leaf_size), items_(std::make_unique_for_overwrite<Item[]>(boxes.size())), numbers_(boxes.size()) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, boxes.size(), parallel_size), [&](const auto& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) {
        const auto& [min, max] = boxes[i];
        items_[i] = {{min.x, min.y, min.z}, uint32_t(i), {max.x, max.y, max.z}, 0};
      }
    });
  }

  std::unique_ptr<Part> split(uint32_t first, uint32_t count, int depth) {
    const std::span<Item> items(&items_[first], count);
    if (count <= swept) return Sweeper(items, leaf_size_).split(depth, first, &numbers_[first]);
    auto part = std::make_unique<Part>();
    part->first = first;
    part->count = count;
    const Extent extent = reduce<Extent>(items, [](const Item& item, Extent& e) {
      const WideBox box = WideBox::of(item);
      e.whole.add(box);
      e.centres.add({box.centre(), box.centre()});
    });
    part->box = extent.whole.box();
    uint32_t left = depth < depth_by_area ? bin(items, extent.centres) : 0;
    if (left == 0) left = halve(items, part->box);
    const auto split_left = [&] { part->left = split(first, left, depth + 1); };
    const auto split_right = [&] { part->right = split(first + left, count - left, depth + 1); };
    if (count > parallel_size) {
      tbb::parallel_invoke(split_left, split_right);
    } else {
      split_left();
      split_right();
    }
    return part;
  }

  std::vector<uint32_t> take_numbers() { return std::move(numbers_); }

 private:
  /// Each of these returns how many go to the left; 0 when there is no way to tell.
  uint32_t halve(std::span<Item> items, const Box& whole) const {
    const int axis = longest_axis(whole.max - whole.min);
    const uint32_t left = half_of(uint32_t(items.size()), leaf_size_);
    std::nth_element(items.begin(), items.begin() + left, items.end(), [&](const Item& a, const Item& b) {
      const float ca = a.min[axis] + a.max[axis], cb = b.min[axis] + b.max[axis];
      return ca != cb ? ca < cb : a.number < b.number;
    });
    return left;
  }

  uint32_t bin(std::span<Item> items, const WideBox& centres) const {
    const BinOf bin_of(centres);
    const Bins filled = reduce<Bins>(items, [&](const Item& item, Bins& into) {
      const WideBox box = WideBox::of(item);
      const Ints at = bin_of(box);
      for (size_t axis = 0; axis < 3; ++axis) {
        into.box[axis][at[axis]].add(box);
        ++into.count[axis][at[axis]];
      }
    });
    const auto count = uint32_t(items.size());
    const Box range = centres.box();
    const glm::vec3 extent = range.max - range.min;
    float least = infinity;
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(extent[axis] > 0.0f) || !std::isfinite(extent[axis])) continue;
      const WideBox* box = filled.box[axis];
      const uint32_t* counts = filled.count[axis];
      std::array<float, bins> right_cost{};
      WideBox right;
      uint32_t right_count = 0;
      for (size_t b = bins; b-- > 1;) {
        right.add(box[b]);
        right_count += counts[b];
        right_cost[b] = right_count > 0 ? cost(right.half_area(), right_count, leaf_size_) : 0.0f;
      }
      WideBox left;
      uint32_t left_count = 0;
      for (size_t b = 1; b < bins; ++b) {
        left.add(box[b - 1]);
        left_count += counts[b - 1];
        if (left_count == 0 || left_count == count) continue;
        const float c = cost(left.half_area(), left_count, leaf_size_) + right_cost[b];
        if (c < least) {
          least = c;
          best_axis = axis;
          best_bin = int(b);
        }
      }
    }
    if (best_axis < 0) return 0;
    const auto middle = std::partition(
        items.begin(), items.end(), [&](const Item& item) { return bin_of(WideBox::of(item))[best_axis] < best_bin; });
    return uint32_t(middle - items.begin());
  }

  uint32_t leaf_size_;
  std::unique_ptr<Item[]> items_;
  std::vector<uint32_t> numbers_;
};

}  // namespace

AreaTree::AreaTree(std::span<const Box> boxes, uint32_t leaf_size) {
  Builder builder(boxes, leaf_size);
  root = builder.split(0, uint32_t(boxes.size()), 0);
  order = builder.take_numbers();
}

}  // namespace omma
