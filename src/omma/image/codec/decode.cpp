#include "omma/image/codec/decode.h"

#include <OpenEXRConfig.h>
#include <fmt/format.h>
#include <spng.h>
#include <tiffvers.h>
#include <webp/decode.h>
#include <zlib.h>

#include <cctype>
#include <cstdio>
//
#include <jpeglib.h>

namespace omma {
namespace {

using namespace std::string_view_literals;

using Decode = Pixels (*)(std::string_view bytes, const Accept& accept);

struct Mark {
  std::string_view begin;
  Decode decode;
};

constexpr Mark marks[] = {
    {"\x89PNG"sv, decode_png}, {"\xff\xd8\xff"sv, decode_jpeg}, {"\x76\x2f\x31\x01"sv, decode_exr},
    {"RIFF"sv, decode_webp},   {"II*\0"sv, decode_tiff},        {"MM\0*"sv, decode_tiff},
    {"II+\0"sv, decode_tiff},  {"MM\0+"sv, decode_tiff},
};

/// TGA has no mark of its own, and stb_image does not know every BMP.
bool is_of_stb(std::string_view bytes, const std::string& extension) {
  if (bytes.starts_with("#?") || bytes.starts_with("GIF8")) return true;
  return (bytes.starts_with("BM") || extension == ".tga") && stb_knows(bytes);
}

}  // namespace

Pixels decode_picture(std::string_view bytes, const std::string& extension, const Accept& accept) {
  for (const Mark& mark : marks) {
    if (bytes.starts_with(mark.begin)) return mark.decode(bytes, accept);
  }
  std::string lower = extension;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (is_of_stb(bytes, lower)) return decode_by_stb(bytes, accept);
  return decode_by_openimageio(bytes, lower, accept);
}

std::vector<std::pair<std::string, std::string>> codec_versions() {
  const int webp = WebPGetDecoderVersion(), jpeg = LIBJPEG_TURBO_VERSION_NUMBER;
  return {{"libspng", spng_version_string()},
          {"zlib", zlibVersion()},
          {"libjpeg-turbo", fmt::format("{}.{}.{}", jpeg / 1000000, jpeg / 1000 % 1000, jpeg % 1000)},
          {"OpenEXR", OPENEXR_VERSION_STRING},
          {"libwebp", fmt::format("{}.{}.{}", webp >> 16, webp >> 8 & 0xff, webp & 0xff)},
          {"libtiff", fmt::format("{}.{}.{}", TIFFLIB_MAJOR_VERSION, TIFFLIB_MINOR_VERSION, TIFFLIB_MICRO_VERSION)}};
}

}  // namespace omma
