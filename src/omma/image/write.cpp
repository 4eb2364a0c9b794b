#include "omma/image/write.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/image/codec/encode.h"
#include "omma/image/formats.h"
#include "omma/image/npy.h"
#include "omma/image/pfm.h"
#include "omma/image/srgb8.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

const ImageFormatInfo& format_for(const fs::path& path, const ChannelInfo& channel) {
  const ImageFormatInfo* format = find_image_format(path);
  if (!format) {
    throw CommandError("{}: '{}' is no image format; {} are", path.string(), path.extension().string(),
                       all_image_extensions());
  }
  if (!format->holds(channel)) {
    throw CommandError("{}: {} cannot hold channel '{}'; {} can", path.string(), format->extensions.front(),
                       channel.name, formats_that_hold(channel));
  }
  return *format;
}

/// As people know them from other tools' EXR files.
std::vector<std::string> component_names(const ChannelInfo& channel) {
  switch (channel.channel) {
    case Channel::color:
      return {"R", "G", "B"};
    case Channel::normal:
    case Channel::position:
      return {"X", "Y", "Z"};
    case Channel::uv:
      return {"U", "V"};
    default:
      return {channel.name};
  }
}

/// Encoded in memory, so that a full disk is noticed in one place.
template <typename Encode>
void write_encoded(const fs::path& path, const Encode& encode) {
  std::string bytes;
  try {
    bytes = encode();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw MachineError("{}: cannot be encoded ({})", path.string(), error.what());
  }
  write_text(path, bytes);
}

/// `fill`: as that of Rows.
void write_srgb8(const fs::path& path, ImageFormat format, ImageSize size, std::function<void(int, uint8_t*)> fill,
                 const std::optional<PanoramaPlace>& panorama) {
  constexpr int jpeg_quality = 95;
  const std::string xmp = panorama ? gpano_xmp(*panorama, size) : std::string();
  const Rows rows{.size = size, .fill = std::move(fill)};
  write_encoded(path, [&] {
    return format == ImageFormat::jpg ? encode_jpeg(rows, jpeg_quality, xmp) : encode_png(rows, true, xmp);
  });
}

void write_png16(const fs::path& path, const IntImage& image, const ChannelInfo& channel) {
  constexpr int largest = 65534;
  for (const int32_t value : image.values) {
    if (value < -1 || value > largest) {
      throw CommandError("{}: .png holds numbers up to {}, this picture has {} {}; .exr, .npy hold it", path.string(),
                         largest, channel.name, value);
    }
  }
  const Rows rows{.size = image.size, .components = image.components, .bits = 16, .fill = [&](int y, uint8_t* to) {
                    const int32_t* from = image.at(0, y);
                    for (int i = 0; i < image.size.width * image.components; ++i) {
                      const int32_t number = from[i] + 1;
                      *to++ = static_cast<uint8_t>(number >> 8);
                      *to++ = static_cast<uint8_t>(number);
                    }
                  }};
  write_encoded(path, [&] { return encode_png(rows, false, {}); });
}

template <typename T>
void write_exr(const fs::path& path, const ImageOf<T>& image, const ChannelInfo& channel,
               const std::optional<PanoramaPlace>& panorama) {
  const ExrPicture picture{.size = image.size,
                           .channels = component_names(channel),
                           // -1 and 4294967295 are the same 32 bits.
                           .type = std::is_same_v<T, float> ? ExrType::float32 : ExrType::uint32,
                           .samples = image.values.data(),
                           .latlong = panorama && panorama->full == image.size};
  write_encoded(path, [&] { return encode_exr(picture); });
}

template <typename T>
void write_npy_image(const fs::path& path, const ImageOf<T>& image) {
  std::vector<size_t> shape{size_t(image.size.height), size_t(image.size.width)};
  if (image.components > 1) shape.push_back(size_t(image.components));
  write_npy<T>(path, shape, image.values);
}

}  // namespace

void check_image_output(const fs::path& path, Channel channel) {
  format_for(path, channel_info(channel));
  require_writable(path);
}

void write_image(const fs::path& path, const Image& image, Channel channel,
                 const std::optional<PanoramaPlace>& panorama) {
  const ChannelInfo& info = channel_info(channel);
  const ImageFormat format = format_for(path, info).format;
  const auto* floats = std::get_if<FloatImage>(&image);
  if (image_components(image) != info.components || (floats == nullptr) != info.integer) {
    throw CommandError("{}: the image is no channel '{}': {} components of {} are expected", path.string(), info.name,
                       info.components, info.integer ? "whole numbers" : "floats");
  }
  const std::optional<PanoramaPlace> place = channel == Channel::color ? panorama : std::nullopt;
  std::visit(
      [&]<typename T>(const ImageOf<T>& typed) {
        if (format == ImageFormat::npy) return write_npy_image(path, typed);
        if (format == ImageFormat::exr) return write_exr(path, typed, info, place);
        if constexpr (std::is_same_v<T, int32_t>) {
          write_png16(path, typed, info);
        } else {
          if (format == ImageFormat::pfm) return write_pfm(path, typed);
          const auto fill = [&](int y, uint8_t* to) { srgb8_row(typed.at(0, y), size_t(typed.size.width), 3, to); };
          write_srgb8(path, format, typed.size, fill, place);
        }
      },
      image);
}

bool holds_bytes_of_color(const fs::path& path) {
  const ImageFormatInfo* format = find_image_format(path);
  return format != nullptr && (format->format == ImageFormat::png || format->format == ImageFormat::jpg);
}

void write_image(const fs::path& path, const ByteImage& color, const std::optional<PanoramaPlace>& panorama) {
  const ImageFormat format = format_for(path, channel_info(Channel::color)).format;
  if (!holds_bytes_of_color(path) || color.components != 3) {
    throw CommandError("{}: three bytes a pixel go into .png and .jpg alone", path.string());
  }
  const auto fill = [&](int y, uint8_t* to) { std::copy_n(color.at(0, y), 3 * size_t(color.size.width), to); };
  write_srgb8(path, format, color.size, fill, panorama);
}

}  // namespace omma
