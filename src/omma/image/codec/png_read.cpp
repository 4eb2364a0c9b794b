// PNG by libspng.
#include <fmt/format.h>
#include <spng.h>

#include <memory>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"

namespace omma {
namespace {

using Reader = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

void check(int status, const char* what) {
  if (status != SPNG_OK) throw InputError("broken or truncated {}: {}", what, spng_strerror(status));
}

/// How libspng is to hand out the pixels, and what they are then.
struct Layout {
  int format = 0;
  int components = 0;
};

Layout layout_of(const spng_ihdr& header, bool transparent) {
  const bool wide = header.bit_depth == 16;
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      if (transparent) return {wide ? SPNG_FMT_GA16 : SPNG_FMT_GA8, 2};
      return {wide ? SPNG_FMT_PNG : SPNG_FMT_G8, 1};
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return {SPNG_FMT_PNG, 2};
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
      return {SPNG_FMT_PNG, 4};
    default:  // RGB and palettes
      if (transparent) return {wide ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8, 4};
      return {wide ? SPNG_FMT_PNG : SPNG_FMT_RGB8, 3};
  }
}

}  // namespace

Pixels decode_png(std::string_view bytes, const Accept& accept) {
  const Reader reader(spng_ctx_new(0), spng_ctx_free);
  if (!reader) throw std::bad_alloc();
  constexpr size_t largest_chunk = size_t{1} << 26;  // of those beside the pixels: profiles, texts
  spng_set_chunk_limits(reader.get(), largest_chunk, largest_chunk);
  spng_set_crc_action(reader.get(), SPNG_CRC_ERROR, SPNG_CRC_DISCARD);
  check(spng_set_png_buffer(reader.get(), bytes.data(), bytes.size()), "PNG");
  spng_ihdr header{};
  check(spng_get_ihdr(reader.get(), &header), "PNG header");
  spng_trns transparency{};
  const Layout layout = layout_of(header, spng_get_trns(reader.get(), &transparency) == SPNG_OK);

  Pixels pixels;
  pixels.info.size = {static_cast<int>(header.width), static_cast<int>(header.height)};
  pixels.info.components = layout.components;
  pixels.info.alpha = layout.components % 2 == 0 ? layout.components - 1 : -1;
  accept(pixels.info);
  const auto decode = [&]<typename T>(SampleVector<T> samples) {
    check(spng_decode_image(reader.get(), samples.data(), samples.size() * sizeof(T), layout.format, SPNG_DECODE_TRNS),
          "PNG");
    pixels.samples = std::move(samples);
  };
  if (header.bit_depth == 16) {
    decode(SampleVector<uint16_t>(pixels.count()));
  } else {
    decode(SampleVector<uint8_t>(pixels.count()));
  }
  check(spng_decode_chunks(reader.get()), "PNG");  // the mark of the end is part of a whole file
  return pixels;
}

}  // namespace omma
