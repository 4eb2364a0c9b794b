// Which pieces are where: squares of the image with the pieces that reach into them, and pieces that lie under others.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "omma/base/error.h"
#include "omma/camera/pieces/piece_set.h"
#include "omma/camera/pieces/places.h"

namespace omma {
namespace {

constexpr int64_t bin_places = int64_t{PieceSet::bin_side} * piece_grid;

// Squares `first` to `last` along one axis, both included, that lie between two places.
struct BinRange {
  int first = 0, last = 0;

  BinRange(int64_t low, int64_t high, int count) {
    const auto bin_of = [&](int64_t place) {
      const int64_t shifted = place + bin_places;  // the first square lies before the image
      const int64_t bin = shifted >= 0 ? shifted / bin_places : (shifted - bin_places + 1) / bin_places;
      return std::clamp<int64_t>(bin, -1, count);
    };
    first = static_cast<int>(std::max<int64_t>(bin_of(low), 0));
    last = static_cast<int>(std::min<int64_t>(bin_of(high), count - 1));
  }
  int64_t count() const { return std::max(0, last - first + 1); }
};

template <typename Visit>
void for_each_bin(const PolygonOnGrid& polygon, const glm::ivec2& counts, Visit visit) {
  const glm::i64vec2 low = polygon.low(), high = polygon.high();
  const BinRange columns(low.x, high.x, counts.x), rows(low.y, high.y, counts.y);
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int column = columns.first; column <= columns.last; ++column) {
      const glm::i64vec2 corner = (glm::i64vec2(column, row) - int64_t{1}) * bin_places;
      if (polygon.meets(corner, corner + bin_places)) visit(static_cast<size_t>(row) * counts.x + column);
    }
  }
}

}  // namespace

void PieceSet::fill_bins(const std::string& beginning) {
  constexpr int64_t most_covers = 300;
  bin_counts_ = {(size_.width + bin_side - 1) / bin_side + 2, (size_.height + bin_side - 1) / bin_side + 2};
  const size_t bins = static_cast<size_t>(bin_counts_.x) * bin_counts_.y;
  int64_t work = 0;
  for (const Piece& piece : pieces_) {
    const PolygonOnGrid polygon(piece);
    const glm::i64vec2 low = polygon.low(), high = polygon.high();
    work += BinRange(low.x, high.x, bin_counts_.x).count() * BinRange(low.y, high.y, bin_counts_.y).count();
  }
  // Small pieces touch up to four squares each, and those along the image's border a few more.
  if (work > most_covers * static_cast<int64_t>(bins) + 16 * static_cast<int64_t>(pieces_.size())) {
    throw CommandError("{}the pieces cover the image more than {} times over", beginning, most_covers);
  }
  bin_first_.assign(bins + 1, 0);
  for (const Piece& piece : pieces_) {
    for_each_bin(PolygonOnGrid(piece), bin_counts_, [&](size_t bin) { ++bin_first_[bin + 1]; });
  }
  for (size_t bin = 0; bin < bins; ++bin) bin_first_[bin + 1] += bin_first_[bin];
  bin_pieces_.resize(bin_first_.back());
  std::vector<uint32_t> next(bin_first_.begin(), bin_first_.end() - 1);
  for (uint32_t i = 0; i < pieces_.size(); ++i) {
    for_each_bin(PolygonOnGrid(pieces_[i]), bin_counts_, [&](size_t bin) { bin_pieces_[next[bin]++] = i; });
  }
}

void PieceSet::find_contested() {
  std::vector<std::atomic<bool>> found(pieces_.size());
  tbb::parallel_for(size_t{0}, bin_first_.size() - 1, [&](size_t bin) {
    struct Entry {
      uint32_t piece;
      PolygonOnGrid polygon;
      glm::i64vec2 low, high;
    };
    std::vector<Entry> entries;
    for (uint32_t i = bin_first_[bin]; i < bin_first_[bin + 1]; ++i) {
      const PolygonOnGrid polygon(pieces_[bin_pieces_[i]]);
      entries.push_back({bin_pieces_[i], polygon, polygon.low(), polygon.high()});
    }
    // From left to right, so that only those are compared that have columns in common.
    std::ranges::sort(entries, {}, [](const Entry& entry) { return entry.low.x; });
    for (size_t a = 0; a < entries.size(); ++a) {
      for (size_t b = a + 1; b < entries.size() && entries[b].low.x < entries[a].high.x; ++b) {
        const bool apart = entries[b].low.y >= entries[a].high.y || entries[a].low.y >= entries[b].high.y;
        const uint32_t later = std::max(entries[a].piece, entries[b].piece);
        if (apart || found[later].load(std::memory_order_relaxed)) continue;
        if (entries[a].polygon.overlaps(entries[b].polygon)) found[later].store(true, std::memory_order_relaxed);
      }
    }
  });
  contested_.assign(pieces_.size(), false);
  for (size_t i = 0; i < pieces_.size(); ++i) contested_[i] = found[i];
}

}  // namespace omma
