// JPEG by libjpeg.
#include <cstdlib>
#include <string_view>
#include <vector>

#include "omma/base/error.h"
#include "omma/image/codec/encode.h"
#include "omma/image/codec/jpeg_error.h"

namespace omma {
namespace {

using namespace std::string_view_literals;

struct Writer {
  jpeg_compress_struct jpeg{};
  JpegErrors errors{};
  unsigned char* bytes = nullptr;  ///< libjpeg's malloc
  unsigned long size = 0;

  Writer() { jpeg.err = prepare(errors); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() {
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
  }

  template <typename Work>
  void step(const Work& work) {
    const std::string why = guarded(errors, work);
    if (!why.empty()) throw MachineError("{}", why);
  }
};

/// Exif 2.3 that says no more than that the numbers are sRGB's.
constexpr std::string_view exif_srgb =
    "Exif\0\0II*\0\x08\0\0\0"
    "\1\0\x69\x87\4\0\1\0\0\0\x1a\0\0\0\0\0\0\0"                               // the directory of what follows
    "\4\0\0\x90\7\0\4\0\0\0\x30\x32\x33\x30\1\x91\7\0\4\0\0\0\1\2\3\0"         // version 2.3; Y, Cb, Cr
    "\0\xa0\7\0\4\0\0\0\x30\x31\x30\x30\1\xa0\3\0\1\0\0\0\1\0\0\0\0\0\0\0"sv;  // FlashPix 1.0; sRGB

void write_app1(jpeg_compress_struct& jpeg, std::string_view segment) {
  jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(segment.data()),
                    static_cast<unsigned>(segment.size()));
}

}  // namespace

std::string encode_jpeg(const Rows& rows, int quality, const std::string& xmp) {
  // XMP Specification Part 3 (Adobe), 1.1.3: a segment APP1, after JFIF's, which has to be the first.
  const std::string packet = xmp.empty() ? "" : std::string("http://ns.adobe.com/xap/1.0/\0"sv) + xmp;
  Writer writer;
  jpeg_compress_struct& jpeg = writer.jpeg;
  std::vector<uint8_t> row(rows.row_bytes());
  writer.step([&] {
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &writer.bytes, &writer.size);
    jpeg.image_width = static_cast<JDIMENSION>(rows.size.width);
    jpeg.image_height = static_cast<JDIMENSION>(rows.size.height);
    jpeg.input_components = rows.components;
    jpeg.in_color_space = rows.components == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    for (int c = 0; c < jpeg.num_components; ++c) {
      jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
    }
    jpeg_start_compress(&jpeg, TRUE);
    if (!packet.empty()) write_app1(jpeg, packet);
    write_app1(jpeg, exif_srgb);
  });
  for (int y = 0; y < rows.size.height; ++y) {
    rows.fill(y, row.data());
    writer.step([&] {
      uint8_t* line = row.data();
      jpeg_write_scanlines(&jpeg, &line, 1);
    });
  }
  writer.step([&] { jpeg_finish_compress(&jpeg); });
  return {reinterpret_cast<const char*>(writer.bytes), writer.size};
}

}  // namespace omma
