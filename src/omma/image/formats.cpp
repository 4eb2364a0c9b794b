#include "omma/image/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace omma {

const std::vector<ImageFormatInfo>& image_formats() {
  static const std::vector<ImageFormatInfo> table{
      {ImageFormat::png,
       {".png"},
       [](const ChannelInfo& channel) { return channel.channel == Channel::color || channel.integer; }},
      {ImageFormat::jpg,
       {".jpg", ".jpeg"},
       [](const ChannelInfo& channel) { return channel.channel == Channel::color; }},
      {ImageFormat::exr, {".exr"}, [](const ChannelInfo&) { return true; }},
      {ImageFormat::pfm,
       {".pfm"},
       [](const ChannelInfo& channel) { return !channel.integer && channel.components != 2; }},
      {ImageFormat::npy, {".npy"}, [](const ChannelInfo&) { return true; }},
  };
  return table;
}

const ImageFormatInfo* find_image_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const ImageFormatInfo& info : image_formats()) {
    if (std::count(info.extensions.begin(), info.extensions.end(), extension)) return &info;
  }
  return nullptr;
}

std::string formats_that_hold(const ChannelInfo& channel) {
  std::vector<std::string> names;
  for (const ImageFormatInfo& info : image_formats()) {
    if (info.holds(channel)) names.push_back(info.extensions.front());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string all_image_extensions() {
  std::vector<std::string> names;
  for (const ImageFormatInfo& info : image_formats()) {
    names.insert(names.end(), info.extensions.begin(), info.extensions.end());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace omma
