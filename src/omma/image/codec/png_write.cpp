// PNG (W3C, Portable Network Graphics, third edition). The file is a frame of chunks around one deflated stream, which
// is made in bands on all processors.
#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <string_view>

#include "omma/image/codec/deflate_bands.h"
#include "omma/image/codec/encode.h"

namespace omma {
namespace {

using namespace std::string_view_literals;

std::string big_endian(uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
  return text;
}

std::string chunk(std::string_view type, std::string_view content) {
  const auto crc_of = [](uLong before, std::string_view text) {
    return crc32_z(before, reinterpret_cast<const Bytef*>(text.data()), text.size());
  };
  std::string text = big_endian(static_cast<uint32_t>(content.size()));
  text.append(type).append(content);
  return text.append(big_endian(static_cast<uint32_t>(crc_of(crc_of(0, type), content))));
}

std::string header(const Rows& rows) {
  std::string text = big_endian(static_cast<uint32_t>(rows.size.width));
  text += big_endian(static_cast<uint32_t>(rows.size.height));
  text += static_cast<char>(rows.bits);
  text += static_cast<char>(rows.components == 3 ? 2 : 0);  // RGB or grey
  return text + std::string(3, '\0');                       // deflate, the five filters, not interlaced
}

/// sRGB, and for readers that do not know it the nearest gamma and its primaries, as the standard gives them.
std::string srgb_chunks() {
  constexpr char absolute_colorimetric = 3;
  std::string primaries;
  for (const uint32_t value : {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000}) primaries += big_endian(value);
  return chunk("gAMA", big_endian(45455)) + chunk("cHRM", primaries) +
         chunk("sRGB", std::string_view(&absolute_colorimetric, 1));
}

/// Paeth's choice of the three neighbours. In 16 bits and without a branch, of which a processor does many at once.
inline uint8_t paeth(int16_t left, int16_t above, int16_t corner) {
  const int16_t p = above - corner, q = left - corner, r = p + q;
  const int16_t from_left = p < 0 ? -p : p, from_above = q < 0 ? -q : q, from_corner = r < 0 ? -r : r;
  const int16_t least = std::min(from_left, std::min(from_above, from_corner));
  const int16_t other = from_above == least ? above : corner;
  return static_cast<uint8_t>(from_left == least ? left : other);
}

/// Each byte becomes its difference from what its neighbours let expect. `above` is null in a band's first row, which
/// is compared with its left neighbour alone, so that no band needs another's rows.
void filter_row(const uint8_t* row, const uint8_t* above, size_t size, size_t pixel, uint8_t* __restrict to) {
  enum : uint8_t { sub = 1, by_paeth = 4 };
  *to++ = above == nullptr ? sub : by_paeth;
  for (size_t i = 0; i < pixel; ++i) to[i] = static_cast<uint8_t>(row[i] - (above == nullptr ? 0 : above[i]));
  if (above == nullptr) {
    for (size_t i = pixel; i < size; ++i) to[i] = static_cast<uint8_t>(row[i] - row[i - pixel]);
  } else {
    for (size_t i = pixel; i < size; ++i) {
      to[i] = static_cast<uint8_t>(row[i] - paeth(row[i - pixel], above[i], above[i - pixel]));
    }
  }
}

struct Band {
  std::string chunk;  ///< IDAT
  uint32_t adler = 0;
  size_t bytes = 0;
};

/// What a thread needs, kept from band to band: fresh memory would cost as much as the filter.
struct Workplace {
  std::vector<uint8_t> row, above, filtered;
  BandDeflater deflate;

  Band make_band(const Rows& rows, int first, int end) {
    const size_t size = rows.row_bytes(), pixel = size / size_t(rows.size.width);
    row.resize(size);
    above.resize(size);
    filtered.resize(size_t(end - first) * (size + 1));
    for (int y = first; y < end; ++y) {
      rows.fill(y, row.data());
      uint8_t* to = &filtered[size_t(y - first) * (size + 1)];
      filter_row(row.data(), y == first ? nullptr : above.data(), size, pixel, to);
      row.swap(above);
    }
    Band band;
    band.chunk = chunk("IDAT", deflate(filtered, end == rows.size.height));
    band.adler = static_cast<uint32_t>(adler32_z(adler32_z(0, nullptr, 0), filtered.data(), filtered.size()));
    band.bytes = filtered.size();
    return band;
  }
};

}  // namespace

std::string encode_png(const Rows& rows, bool srgb, const std::string& xmp) {
  // Large enough that what a band does not see of the others costs nothing, small enough for many processors.
  constexpr size_t band_bytes = size_t{1} << 18;
  const int band_rows = static_cast<int>(std::max<size_t>(1, band_bytes / (rows.row_bytes() + 1)));
  std::vector<Band> bands(size_t((rows.size.height + band_rows - 1) / band_rows));
  oneapi::tbb::enumerable_thread_specific<Workplace> workplaces;
  oneapi::tbb::parallel_for(size_t{0}, bands.size(), [&](size_t i) {
    const int first = static_cast<int>(i) * band_rows;
    bands[i] = workplaces.local().make_band(rows, first, std::min(first + band_rows, rows.size.height));
  });

  std::string text("\x89PNG\r\n\x1a\n"sv);
  text += chunk("IHDR", header(rows));
  if (srgb) text += srgb_chunks();
  // XMP Specification Part 3 (Adobe), 1.1.5.
  if (!xmp.empty()) text += chunk("iTXt", std::string("XML:com.adobe.xmp\0\0\0\0\0"sv) + xmp);
  text += chunk("IDAT", "\x78\x01");  // a zlib stream with a window of 32 KiB
  uLong adler = adler32_z(0, nullptr, 0);
  for (const Band& band : bands) {
    text += band.chunk;
    adler = adler32_combine(adler, band.adler, static_cast<z_off_t>(band.bytes));
  }
  return text + chunk("IDAT", big_endian(static_cast<uint32_t>(adler))) + chunk("IEND", "");
}

}  // namespace omma
