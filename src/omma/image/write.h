// Writing images; the extension is the format.
//
//   .png   color: 8-bit sRGB; id, object, material: 16 bits, number + 1, 0 where there is nothing (up to 65534)
//   .jpg   color: 8-bit sRGB, quality 95, no chroma subsampling
//   .exr   every channel: 32-bit float; id, object, material: 32-bit unsigned, 4294967295 where there is nothing
//   .pfm   every channel of floats but uv: 32-bit, rows from the bottom, little-endian
//   .npy   every channel: float32 or int32, H x W or H x W x components, rows from the top
#pragma once

#include <filesystem>
#include <optional>

#include "omma/image/image.h"
#include "omma/image/metadata.h"

namespace omma {

/// Throws CommandError when the file could not be written: an extension that is no format, a format that cannot hold
/// the channel, a folder that is missing.
void check_image_output(const std::filesystem::path& path, Channel channel);

/// The file is there whole or not at all. Throws as check_image_output does, CommandError for numbers above 65534 in a
/// .png, and MachineError when the disk refuses. Colour that is (part of) a panorama says so: GPano XMP in .jpg and
/// .png, and in .exr `envmap` where it is the whole sphere.
void write_image(const std::filesystem::path& path, const Image& image, Channel channel,
                 const std::optional<PanoramaPlace>& panorama = std::nullopt);

/// Colour alone goes there, of 8 bits: a .png or .jpg.
bool holds_bytes_of_color(const std::filesystem::path& path);
/// The same of colour that is encoded already (PixelFormat::srgb8).
void write_image(const std::filesystem::path& path, const ByteImage& color,
                 const std::optional<PanoramaPlace>& panorama = std::nullopt);

}  // namespace omma
