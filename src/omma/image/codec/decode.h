// From the bytes of a file to pixels. All of these throw InputError, without the file's name, for what is broken,
// truncated or beyond what they read, and none says anything by itself.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "omma/image/codec/pixels.h"

namespace omma {

/// The content says which format it is; `extension` (".tga", in either case, or empty) counts for formats that do not
/// begin with a mark of their own. PNG, JPEG, OpenEXR, WebP, TIFF, Radiance HDR, BMP, GIF (its first frame) and TGA are
/// read by libraries that are always there; everything else by OpenImageIO, which is loaded when such a file is met.
Pixels decode_picture(std::string_view bytes, const std::string& extension, const Accept& accept);

/// Palettes and fewer than 8 bits are expanded; 16 bits stay. Alpha is not multiplied into colour.
Pixels decode_png(std::string_view bytes, const Accept& accept);
/// One or three components; CMYK is turned into RGB.
Pixels decode_jpeg(std::string_view bytes, const Accept& accept);
/// The first part. R, G, B, A come first, then other channels by name; uint32 where all are, else floats.
Pixels decode_exr(std::string_view bytes, const Accept& accept);
/// The first frame.
Pixels decode_webp(std::string_view bytes, const Accept& accept);
/// 8, 16 and 32 bits of grey and RGB as they are; palettes, YCbCr, CMYK and fewer bits as 8-bit RGB.
Pixels decode_tiff(std::string_view bytes, const Accept& accept);
/// Radiance HDR, BMP, GIF and TGA; whether the header is one of those.
bool stb_knows(std::string_view bytes);
Pixels decode_by_stb(std::string_view bytes, const Accept& accept);
/// Whatever OpenImageIO reads, as 8 bits.
Pixels decode_by_openimageio(std::string_view bytes, const std::string& extension, const Accept& accept);

/// The libraries above with their versions, for reports.
std::vector<std::pair<std::string, std::string>> codec_versions();

}  // namespace omma
