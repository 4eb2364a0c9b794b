// Memory of the caller's that a picture is written into.
#pragma once

#include <cstddef>
#include <cstdint>

#include "omma/image/image.h"

namespace omma {

/// What a pixel is in memory; components lie beside each other.
enum class PixelFormat {
  float32,  ///< every channel of floats, as many components as the channel has
  int32,    ///< id, object, material
  srgb8,    ///< color, three bytes: as a screen takes it, and as .png has it
  srgba8,   ///< the same with a fourth byte, 255
};

/// Bytes of a pixel.
size_t pixel_bytes(PixelFormat format, const ChannelInfo& channel);

struct PixelBuffer {
  void* pixels =
      nullptr;           ///< the left pixel of the top row, or of the bottom row where `bottom_up`; aligned as a float
  size_t bytes = 0;      ///< from there on
  size_t row_bytes = 0;  ///< from a row to the next; 0: they follow each other
  PixelFormat format = PixelFormat::float32;
  bool bottom_up = false;  ///< the bottom row comes first, as OpenGL has it
};

/// A channel of a picture, and where it goes.
struct Output {
  Channel channel;
  PixelBuffer to;
};

/// Throws CommandError, with what is expected, for a buffer that is null or too small for a picture of this size, rows
/// that overlap, a place or rows that are not aligned, a format that cannot hold the channel.
void check(const Output& output, ImageSize size);

/// The memory of an image. It must outlive the buffer.
PixelBuffer buffer_of(Image& image);

/// The rows of a checked buffer, from the top.
template <typename T>
struct PixelRows {
  PixelRows() = default;
  PixelRows(const PixelBuffer& buffer, ImageSize image_size, size_t bytes_of_pixel)
      : size(image_size), components(int(bytes_of_pixel / sizeof(T))) {
    const size_t bytes = buffer.row_bytes != 0 ? buffer.row_bytes : size_t(size.width) * bytes_of_pixel;
    row = ptrdiff_t(bytes / sizeof(T));
    first = static_cast<T*>(buffer.pixels);
    if (buffer.bottom_up) {
      first += ptrdiff_t(size.height - 1) * row;
      row = -row;
    }
  }
  T* at(int x, int y) const { return first + ptrdiff_t(y) * row + ptrdiff_t(x) * components; }
  explicit operator bool() const { return first != nullptr; }

  T* first = nullptr;
  ptrdiff_t row = 0;  ///< from a row to the one below it
  ImageSize size{};
  int components = 1;
};

/// Sets every pixel to what the channel says where nothing is. Runs on all cores.
void fill_with_nothing(const Output& output, ImageSize size);

/// Writes an image of the output's channel. Runs on all cores.
void copy_image(const Image& image, const Output& output);

}  // namespace omma
