// The image formats and what each can hold.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "omma/image/image.h"

namespace omma {

enum class ImageFormat { png, jpg, exr, pfm, npy };

struct ImageFormatInfo {
  ImageFormat format;
  std::vector<std::string> extensions;  ///< lower case, with the dot; the first is the usual one
  bool (*holds)(const ChannelInfo&);
};

const std::vector<ImageFormatInfo>& image_formats();

/// By extension, in either case; null when it is none of them.
const ImageFormatInfo* find_image_format(const std::filesystem::path& path);

/// ".png, .exr, .npy": the formats that can hold `channel`, or all of them.
std::string formats_that_hold(const ChannelInfo& channel);
std::string all_image_extensions();

}  // namespace omma
