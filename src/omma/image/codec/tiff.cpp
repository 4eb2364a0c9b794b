// TIFF by libtiff.
#include <fmt/format.h>
#include <tiffio.h>

#include <cstdio>
#include <cstring>
#include <memory>

#include "omma/base/error.h"
#include "omma/image/codec/decode.h"

namespace omma {
namespace {

/// The file in memory, and what libtiff says of it first.
struct Source {
  std::string_view bytes;
  uint64_t at = 0;
  std::string complaint;
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t read(thandle_t handle, void* to, tmsize_t size) {
  Source& source = source_of(handle);
  const uint64_t left = source.at < source.bytes.size() ? source.bytes.size() - source.at : 0;
  const auto count = std::min(left, static_cast<uint64_t>(size));
  if (count > 0) std::memcpy(to, source.bytes.data() + source.at, count);
  source.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t refuse_to_write(thandle_t, void*, tmsize_t) { return -1; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Source& source = source_of(handle);
  const uint64_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? source.at : source.bytes.size();
  return source.at = base + offset;
}

int stay_open(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return source_of(handle).bytes.size(); }

void keep_complaint(void* user, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  std::string& complaint = source_of(user).complaint;
  if (complaint.empty()) complaint = text;
}

constexpr int said = 1;  // so that libtiff writes nothing to standard error

int on_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  keep_complaint(user, format, arguments);
  return said;
}

/// What lies beyond the end of the file may be a palette, without which the picture is another.
int on_warning(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  if (std::string_view(format).starts_with("IO error")) keep_complaint(user, format, arguments);
  return said;
}

using File = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

File open(Source& source) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &source);
  // m: not mapped, since the whole file is in memory already.
  return {TIFFClientOpenExt("picture", "rm", &source, read, refuse_to_write, seek, stay_open, size_of, nullptr, nullptr,
                            options.get()),
          TIFFClose};
}

uint16_t tag(TIFF* file, uint32_t name) {
  uint16_t value = 0;
  TIFFGetFieldDefaulted(file, name, &value);
  return value;
}

struct Layout {
  uint16_t bits, format, samples, photometric;
  bool planes, tiles;

  explicit Layout(TIFF* file)
      : bits(tag(file, TIFFTAG_BITSPERSAMPLE)),
        format(tag(file, TIFFTAG_SAMPLEFORMAT)),
        samples(tag(file, TIFFTAG_SAMPLESPERPIXEL)),
        photometric(tag(file, TIFFTAG_PHOTOMETRIC)),
        planes(samples > 1 && tag(file, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE),
        tiles(TIFFIsTiled(file) != 0) {}

  int colors() const { return photometric == PHOTOMETRIC_RGB ? 3 : 1; }
  bool is_plain() const {
    const bool grey_or_rgb = photometric == PHOTOMETRIC_RGB || photometric == PHOTOMETRIC_MINISBLACK ||
                             photometric == PHOTOMETRIC_MINISWHITE;
    const bool number = format == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16 || bits == 32);
    return grey_or_rgb && samples >= colors() && (number || (format == SAMPLEFORMAT_IEEEFP && bits == 32));
  }
};

int alpha_of(TIFF* file, const Layout& layout) {
  uint16_t count = 0;
  const uint16_t* kinds = nullptr;
  if (!TIFFGetField(file, TIFFTAG_EXTRASAMPLES, &count, &kinds) || count == 0) return -1;
  return kinds[0] == EXTRASAMPLE_ASSOCALPHA || kinds[0] == EXTRASAMPLE_UNASSALPHA ? layout.colors() : -1;
}

/// Copies what a row or a tile holds to where it belongs: of each pixel the first components, or one of them.
template <typename T>
struct Copier {
  Pixels& pixels;
  SampleVector<T>& samples;
  int in_buffer;  ///< components of a pixel there

  void row(const T* from, int x, int y, int count, int plane) const {
    const int stored = pixels.stored(), copied = in_buffer == 1 ? 1 : stored;
    T* to = samples.data() + (size_t(y) * size_t(pixels.info.size.width) + size_t(x)) * size_t(stored) + plane;
    for (int i = 0; i < count; ++i, from += in_buffer, to += stored) std::copy_n(from, copied, to);
  }
};

void check(bool fine, const Source& source) {
  if (!fine) throw InputError("broken or truncated TIFF: {}", source.complaint);
}

template <typename T>
SampleVector<T> read_samples(TIFF* file, const Layout& layout, Pixels& pixels, const Source& source) {
  const ImageSize size = pixels.info.size;
  SampleVector<T> samples(pixels.count());
  const Copier<T> copier{pixels, samples, layout.planes ? 1 : layout.samples};
  const int planes = layout.planes ? pixels.stored() : 1;
  if (!layout.tiles) {
    std::vector<T> line(size_t(TIFFScanlineSize64(file)) / sizeof(T) + 1);
    check(line.size() > size_t(size.width) * size_t(copier.in_buffer), source);
    for (int plane = 0; plane < planes; ++plane) {
      for (int y = 0; y < size.height; ++y) {
        check(TIFFReadScanline(file, line.data(), uint32_t(y), uint16_t(plane)) == 1, source);
        copier.row(line.data(), 0, y, size.width, plane);
      }
    }
    return samples;
  }
  uint32_t width = 0, height = 0;
  TIFFGetField(file, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(file, TIFFTAG_TILELENGTH, &height);
  // Tiles are multiples of 16, and the last ones may reach beyond the picture: no more than that, whatever they claim.
  check(width > 0 && height > 0 && width <= 65536 && height <= 65536, source);
  constexpr uint32_t most_beyond = 1024;
  check(width <= uint32_t(size.width) + most_beyond && height <= uint32_t(size.height) + most_beyond, source);
  SampleVector<T> tile(size_t(width) * height * size_t(copier.in_buffer));
  check(size_t(TIFFTileSize64(file)) <= tile.size() * sizeof(T), source);
  for (int plane = 0; plane < planes; ++plane) {
    for (int y0 = 0; y0 < size.height; y0 += int(height)) {
      for (int x0 = 0; x0 < size.width; x0 += int(width)) {
        check(TIFFReadTile(file, tile.data(), uint32_t(x0), uint32_t(y0), 0, uint16_t(plane)) >= 0, source);
        for (int y = y0; y < std::min(y0 + int(height), size.height); ++y) {
          copier.row(tile.data() + size_t(y - y0) * width * size_t(copier.in_buffer), x0, y,
                     std::min(int(width), size.width - x0), plane);
        }
      }
    }
  }
  return samples;
}

template <typename T>
SampleVector<T> read_plain(TIFF* file, const Layout& layout, Pixels& pixels, const Source& source) {
  SampleVector<T> samples = read_samples<T>(file, layout, pixels, source);
  if (layout.photometric == PHOTOMETRIC_MINISWHITE) {
    const T white = std::is_same_v<T, float> ? T(1) : std::numeric_limits<T>::max();
    for (size_t i = 0; i < samples.size(); i += size_t(pixels.stored())) samples[i] = T(white - samples[i]);
  }
  return samples;
}

/// libtiff's own way to 8-bit RGB. Its rows begin at the bottom where the file does not say otherwise.
SampleVector<uint8_t> read_rgb(TIFF* file, const Pixels& pixels, const Source& source) {
  const ImageSize size = pixels.info.size;
  SampleVector<uint32_t> packed(size_t(size.width) * size_t(size.height));
  check(TIFFReadRGBAImageOriented(file, uint32_t(size.width), uint32_t(size.height), packed.data(),
                                  tag(file, TIFFTAG_ORIENTATION), 1) == 1,
        source);
  SampleVector<uint8_t> samples(3 * packed.size());
  for (size_t i = 0; i < packed.size(); ++i) {
    samples[3 * i] = TIFFGetR(packed[i]);
    samples[3 * i + 1] = TIFFGetG(packed[i]);
    samples[3 * i + 2] = TIFFGetB(packed[i]);
  }
  return samples;
}

}  // namespace

Pixels decode_tiff(std::string_view bytes, const Accept& accept) {
  Source source{bytes, 0, {}};
  const File file = open(source);
  check(file != nullptr, source);
  uint32_t width = 0, height = 0;
  TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height);
  if (width < 1 || height < 1 || width > INT32_MAX || height > INT32_MAX) {
    throw InputError("broken TIFF header: {} x {} pixels", width, height);
  }
  const Layout layout(file.get());
  Pixels pixels;
  pixels.info.size = {static_cast<int>(width), static_cast<int>(height)};
  if (layout.is_plain()) {
    pixels.info.components = layout.samples;
    pixels.info.alpha = alpha_of(file.get(), layout);
    accept(pixels.info);
    if (layout.format == SAMPLEFORMAT_IEEEFP) {
      pixels.samples = read_plain<float>(file.get(), layout, pixels, source);
    } else if (layout.bits == 8) {
      pixels.samples = read_plain<uint8_t>(file.get(), layout, pixels, source);
    } else if (layout.bits == 16) {
      pixels.samples = read_plain<uint16_t>(file.get(), layout, pixels, source);
    } else {
      pixels.samples = read_plain<uint32_t>(file.get(), layout, pixels, source);
    }
  } else {
    pixels.info.components = 3;
    accept(pixels.info);
    pixels.samples = read_rgb(file.get(), pixels, source);
  }
  check(source.complaint.empty(), source);  // libtiff goes on where a strip is missing
  return pixels;
}

}  // namespace omma
