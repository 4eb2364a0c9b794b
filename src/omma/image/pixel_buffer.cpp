#include "omma/image/pixel_buffer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "omma/base/error.h"
#include "omma/image/srgb8.h"

namespace omma {
namespace {

bool is_encoded(PixelFormat format) { return format == PixelFormat::srgb8 || format == PixelFormat::srgba8; }

const char* name_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::int32:
      return "int32";
    case PixelFormat::srgb8:
      return "srgb8";
    case PixelFormat::srgba8:
      return "srgba8";
    default:
      return "float32";
  }
}

template <typename T>
PixelRows<T> rows_of(const Output& output, ImageSize size) {
  return {output.to, size, pixel_bytes(output.to.format, channel_info(output.channel))};
}

template <typename Each>
void each_row(ImageSize size, const Each& each) {
  tbb::parallel_for(tbb::blocked_range<int>(0, size.height, 16), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) each(y);
  });
}

}  // namespace

size_t pixel_bytes(PixelFormat format, const ChannelInfo& channel) {
  if (format == PixelFormat::srgb8) return 3;
  if (format == PixelFormat::srgba8) return 4;
  return 4 * size_t(channel.components);
}

void check(const Output& output, ImageSize size) {
  const ChannelInfo& channel = channel_info(output.channel);
  const PixelBuffer& to = output.to;
  const bool holds =
      is_encoded(to.format) ? output.channel == Channel::color : channel.integer == (to.format == PixelFormat::int32);
  if (!holds) {
    throw CommandError("channel '{}' does not go into pixels of {}; {} does", channel.name, name_of(to.format),
                       channel.integer                    ? "int32"
                       : output.channel == Channel::color ? "float32, srgb8, srgba8"
                                                          : "float32");
  }
  if (to.pixels == nullptr) throw CommandError("there is no memory for channel '{}'", channel.name);
  const size_t row = size_t(size.width) * pixel_bytes(to.format, channel);
  const size_t step = to.row_bytes != 0 ? to.row_bytes : row;
  if (step < row) {
    throw CommandError("rows of channel '{}' are {} bytes apart, {} pixels of {} take {}", channel.name, step,
                       size.width, name_of(to.format), row);
  }
  // Not multiplied before it is known to be no more than there is.
  const auto rows_below = size_t(size.height - 1);
  if (to.bytes < row || (rows_below > 0 && step > (to.bytes - row) / rows_below)) {
    throw CommandError(
        "memory of {} bytes for channel '{}', {} x {} pixels of {}, rows {} bytes apart, take {}", to.bytes,
        channel.name, size.width, size.height, name_of(to.format), step,
        step > SIZE_MAX / size_t(size.height) ? "more than can be counted" : std::to_string(step * rows_below + row));
  }
  if (!is_encoded(to.format) && (reinterpret_cast<uintptr_t>(to.pixels) % 4 != 0 || step % 4 != 0)) {
    throw CommandError("memory of channel '{}' is not aligned: pixels of {} and rows begin at multiples of 4 bytes",
                       channel.name, name_of(to.format));
  }
}

PixelBuffer buffer_of(Image& image) {
  return std::visit(
      []<typename T>(ImageOf<T>& typed) {
        const PixelFormat format = std::is_same_v<T, float> ? PixelFormat::float32 : PixelFormat::int32;
        return PixelBuffer{.pixels = typed.values.data(), .bytes = typed.values.size() * sizeof(T), .format = format};
      },
      image);
}

void fill_with_nothing(const Output& output, ImageSize size) {
  const ChannelInfo& channel = channel_info(output.channel);
  const auto fill = [&]<typename T>(const PixelRows<T>& rows, T value) {
    each_row(size, [&](int y) { std::fill_n(rows.at(0, y), size_t(size.width) * size_t(rows.components), value); });
  };
  switch (output.to.format) {
    case PixelFormat::float32:
      return fill(rows_of<float>(output, size), channel.nothing);
    case PixelFormat::int32:
      return fill(rows_of<int32_t>(output, size), int32_t(channel.nothing));
    case PixelFormat::srgb8:
      return fill(rows_of<uint8_t>(output, size), uint8_t(0));
    case PixelFormat::srgba8: {
      const PixelRows<uint8_t> rows = rows_of<uint8_t>(output, size);
      return each_row(size, [&](int y) {
        for (int x = 0; x < size.width; ++x) std::memcpy(rows.at(x, y), "\0\0\0\xff", 4);
      });
    }
  }
}

void copy_image(const Image& image, const Output& output) {
  const ImageSize size = image_size(image);
  const auto copy = [&]<typename T>(const ImageOf<T>& from) {
    const PixelRows<T> rows = rows_of<T>(output, size);
    each_row(size,
             [&](int y) { std::copy_n(from.at(0, y), size_t(size.width) * size_t(from.components), rows.at(0, y)); });
  };
  if (!is_encoded(output.to.format)) return std::visit(copy, image);
  const auto& from = std::get<FloatImage>(image);
  const PixelRows<uint8_t> rows = rows_of<uint8_t>(output, size);
  each_row(size, [&](int y) { srgb8_row(from.at(0, y), size_t(size.width), rows.components, rows.at(0, y)); });
}

}  // namespace omma
