#include "omma/image/write.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/base/names.h"
#include "omma/image/formats.h"
#include "omma/image/npy.h"
#include "omma/image/pfm.h"
#include "omma/image/srgb.h"

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

/// Encodes in memory and writes the bytes ourselves: not every encoder notices a full disk.
void encode(const fs::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels,
            const std::string& xmp = {}) {
  OIIO::Filesystem::IOVecOutput memory;
  const std::string name = "image" + path.extension().string();
  const auto output = OIIO::ImageOutput::create(name, &memory);
  if (!output || !output->open(name, spec) || !output->write_image(type, pixels) || !output->close()) {
    throw MachineError("{}: cannot be encoded ({})", path.string(), output ? output->geterror() : OIIO::geterror());
  }
  std::string bytes(reinterpret_cast<const char*>(memory.buffer().data()), memory.buffer().size());
  if (!xmp.empty()) bytes = with_xmp(std::move(bytes), find_image_format(path)->format, xmp);
  write_text(path, bytes);
}

void write_srgb8(const fs::path& path, const FloatImage& image, const std::optional<PanoramaPlace>& panorama) {
  std::vector<uint8_t> bytes(image.values.size());
  std::transform(image.values.begin(), image.values.end(), bytes.begin(),
                 [](float linear) { return static_cast<uint8_t>(std::lround(255.0f * srgb_from_linear(linear))); });
  OIIO::ImageSpec spec(image.size.width, image.size.height, image.components, OIIO::TypeUInt8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("CompressionQuality", 95);
  spec.attribute("jpeg:subsampling", "4:4:4");
  encode(path, spec, OIIO::TypeUInt8, bytes.data(), panorama ? gpano_xmp(*panorama, image.size) : std::string());
}

void write_png16(const fs::path& path, const IntImage& image, const ChannelInfo& channel) {
  constexpr int largest = 65534;
  std::vector<uint16_t> numbers(image.values.size());
  std::transform(image.values.begin(), image.values.end(), numbers.begin(), [&](int32_t value) {
    if (value < -1 || value > largest) {
      throw CommandError("{}: .png holds numbers up to {}, this picture has {} {}; .exr, .npy hold it", path.string(),
                         largest, channel.name, value);
    }
    return static_cast<uint16_t>(value + 1);
  });
  const OIIO::ImageSpec spec(image.size.width, image.size.height, image.components, OIIO::TypeUInt16);
  encode(path, spec, OIIO::TypeUInt16, numbers.data());
}

template <typename T>
void write_exr(const fs::path& path, const ImageOf<T>& image, const ChannelInfo& channel,
               const std::optional<PanoramaPlace>& panorama) {
  // -1 and 4294967295 are the same 32 bits.
  const OIIO::TypeDesc type = std::is_same_v<T, float> ? OIIO::TypeFloat : OIIO::TypeUInt32;
  OIIO::ImageSpec spec(image.size.width, image.size.height, image.components, type);
  spec.channelnames = component_names(channel);
  spec.attribute("compression", "zip");
  // OpenImageIO's name for OpenEXR's attribute envmap = LATLONG, which knows only the whole sphere.
  if (panorama && panorama->full == image.size) spec.attribute("textureformat", "LatLong Environment");
  encode(path, spec, type, image.values.data());
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
          format == ImageFormat::pfm ? write_pfm(path, typed) : write_srgb8(path, typed, place);
        }
      },
      image);
}

}  // namespace omma
