#include "omma/image/codec/deflate_bands.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace omma {
namespace {

/// How zlib looks for what repeats. Of filtered pictures, almost all that repeats is the byte before, and looking for
/// no more is faster and as good; only patterns that come again and again are worth a search.
enum class Search { runs, matches };

constexpr int level = 1;

}  // namespace

struct BandDeflater::Zlib {
  Zlib() {
    constexpr int raw_window = -15, memory_level = 8;
    if (deflateInit2(&stream, level, Z_DEFLATED, raw_window, memory_level, Z_RLE) != Z_OK) throw std::bad_alloc();
  }
  Zlib(const Zlib&) = delete;
  Zlib& operator=(const Zlib&) = delete;
  ~Zlib() { deflateEnd(&stream); }

  /// Good until the next call.
  std::string_view deflated(std::span<const uint8_t> bytes, Search search, int flush) {
    deflateReset(&stream);
    deflateParams(&stream, level, search == Search::runs ? Z_RLE : Z_FILTERED);
    constexpr size_t mark_of_flush = 16;
    result.resize(std::max(result.size(), deflateBound(&stream, static_cast<uLong>(bytes.size())) + mark_of_flush));
    stream.next_in = const_cast<Bytef*>(bytes.data());  // zlib reads it
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = result.data();
    stream.avail_out = static_cast<uInt>(result.size());
    const int status = deflate(&stream, flush);
    if (status != (flush == Z_FINISH ? Z_STREAM_END : Z_OK)) throw std::logic_error("zlib did not take all");
    return {reinterpret_cast<const char*>(result.data()), stream.total_out};
  }

  /// Tried on a sample from the band's middle.
  Search best_search(std::span<const uint8_t> bytes) {
    constexpr size_t sample_size = 8192;
    const size_t size = std::min(sample_size, bytes.size());
    const auto sample = bytes.subspan((bytes.size() - size) / 2, size);
    const size_t by_runs = deflated(sample, Search::runs, Z_FINISH).size();
    return deflated(sample, Search::matches, Z_FINISH).size() < by_runs ? Search::matches : Search::runs;
  }

  z_stream stream{};
  std::vector<uint8_t> result;
};

BandDeflater::BandDeflater() : zlib_(std::make_unique<Zlib>()) {}
BandDeflater::~BandDeflater() = default;
BandDeflater::BandDeflater(BandDeflater&&) noexcept = default;

std::string BandDeflater::operator()(std::span<const uint8_t> bytes, bool last) {
  const Search search = zlib_->best_search(bytes);
  return std::string(zlib_->deflated(bytes, search, last ? Z_FINISH : Z_SYNC_FLUSH));
}

}  // namespace omma
