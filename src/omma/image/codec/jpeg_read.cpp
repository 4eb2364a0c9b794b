// JPEG by libjpeg.
#include <algorithm>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"
#include "omma/image/codec/jpeg_error.h"

namespace omma {
namespace {

struct Reader {
  jpeg_decompress_struct jpeg{};
  JpegErrors errors{};

  Reader() { jpeg.err = prepare(errors); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { jpeg_destroy_decompress(&jpeg); }

  template <typename Work>
  void step(const Work& work) {
    const std::string why = guarded(errors, work);
    if (!why.empty()) throw InputError("broken or truncated JPEG: {}", why);
  }
};

/// Adobe's programs, which write CMYK, write 255 - x.
void rgb_of_inverse_cmyk(const uint8_t* from, uint8_t* to) {
  for (int c = 0; c < 3; ++c) to[c] = static_cast<uint8_t>((from[c] * from[3] + 127) / 255);
}

}  // namespace

Pixels decode_jpeg(std::string_view bytes, const Accept& accept) {
  Reader reader;
  jpeg_decompress_struct& jpeg = reader.jpeg;
  reader.step([&] {
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg, TRUE);
    if (jpeg.num_components == 4) jpeg.out_color_space = JCS_CMYK;
  });
  const bool cmyk = jpeg.out_color_space == JCS_CMYK;
  Pixels pixels;
  pixels.info.size = {static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height)};
  pixels.info.components = jpeg.num_components == 1 ? 1 : 3;
  accept(pixels.info);
  SampleVector<uint8_t> samples(pixels.count());
  const size_t row = samples.size() / jpeg.image_height;
  std::vector<uint8_t> inks(cmyk ? size_t{4} * jpeg.image_width : 0);
  reader.step([&] {
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
      uint8_t* to = samples.data() + row * jpeg.output_scanline;
      uint8_t* line = cmyk ? inks.data() : to;
      jpeg_read_scanlines(&jpeg, &line, 1);
      for (size_t x = 0; cmyk && x < jpeg.output_width; ++x) rgb_of_inverse_cmyk(&inks[4 * x], to + 3 * x);
    }
    jpeg_finish_decompress(&jpeg);
  });
  pixels.samples = std::move(samples);
  return pixels;
}

}  // namespace omma
