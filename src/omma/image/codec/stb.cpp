// Radiance HDR, BMP, GIF and TGA by stb_image.
#include <cstdlib>
#include <cstring>
#include <memory>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_TGA
// What a broken file leaves unset is black, not what was in memory before.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(block, size) std::realloc(block, size)
#define STBI_FREE(block) std::free(block)
#include <stb_image.h>

namespace omma {
namespace {

/// stb_image reads zeros beyond the end of a file; this notices.
struct Source {
  std::string_view bytes;
  size_t at = 0;
  bool beyond_end = false;

  static int read(void* user, char* to, int size) {
    auto& source = *static_cast<Source*>(user);
    const size_t count = std::min(size_t(size), source.bytes.size() - source.at);
    source.beyond_end |= count == 0 && size > 0;
    std::memcpy(to, source.bytes.data() + source.at, count);
    source.at += count;
    return static_cast<int>(count);
  }
  static void skip(void* user, int count) {  // back, too
    auto& source = *static_cast<Source*>(user);
    const auto at = static_cast<int64_t>(source.at) + count;
    source.beyond_end |= at < 0 || at > static_cast<int64_t>(source.bytes.size());
    source.at = size_t(std::clamp<int64_t>(at, 0, static_cast<int64_t>(source.bytes.size())));
  }
  static int at_end(void* user) {
    const auto& source = *static_cast<Source*>(user);
    return source.at == source.bytes.size() ? 1 : 0;
  }
};

constexpr stbi_io_callbacks callbacks{Source::read, Source::skip, Source::at_end};

[[noreturn]] void fail() {
  throw InputError("it is no picture of a known format, or a broken one ({})", stbi_failure_reason());
}

template <typename T>
SampleVector<T> taken(T* values, size_t count, const Source& source) {
  const std::unique_ptr<T, decltype(&stbi_image_free)> owner(values, stbi_image_free);
  if (values == nullptr) fail();
  if (source.beyond_end) throw InputError("the file is truncated");
  return SampleVector<T>(values, values + count);
}

}  // namespace

bool stb_knows(std::string_view bytes) {
  Source source{bytes};
  int width = 0, height = 0, components = 0;
  return stbi_info_from_callbacks(&callbacks, &source, &width, &height, &components) != 0;
}

Pixels decode_by_stb(std::string_view bytes, const Accept& accept) {
  Pixels pixels;
  ImageSize& size = pixels.info.size;
  Source header{bytes};
  if (!stbi_info_from_callbacks(&callbacks, &header, &size.width, &size.height, &pixels.info.components)) fail();
  if (size.width < 1 || size.height < 1) throw InputError("the file is truncated");
  if (pixels.info.components % 2 == 0) pixels.info.alpha = pixels.info.components - 1;
  accept(pixels.info);
  // GIF's codes stand for the longest runs, 4096 pixels in a byte and a half. Without this its decoder would fill what
  // a header claims before it reads on.
  constexpr size_t most_pixels_a_byte = 4096;
  if (size_t(size.width) * size_t(size.height) / most_pixels_a_byte > bytes.size()) {
    throw InputError("the file is truncated: {} bytes cannot hold {} x {} pixels", bytes.size(), size.width,
                     size.height);
  }
  Source kind{bytes}, source{bytes};
  int width = 0, height = 0, in_file = 0;
  if (stbi_is_hdr_from_callbacks(&callbacks, &kind)) {
    float* values = stbi_loadf_from_callbacks(&callbacks, &source, &width, &height, &in_file, pixels.info.components);
    pixels.samples = taken(values, pixels.count(), source);
  } else {
    stbi_uc* values = stbi_load_from_callbacks(&callbacks, &source, &width, &height, &in_file, pixels.info.components);
    pixels.samples = taken(values, pixels.count(), source);
  }
  return pixels;
}

}  // namespace omma
