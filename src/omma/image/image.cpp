#include "omma/image/image.h"

#include <limits>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {

const std::vector<ChannelInfo>& channels() {
  constexpr float inf = std::numeric_limits<float>::infinity();
  static const std::vector<ChannelInfo> table{
      {Channel::color, "color", 3, false, 0.0f, "RGB, linear light (8-bit files: sRGB)"},
      {Channel::distance, "distance", 1, false, inf, "metres along the ray; +inf: nothing"},
      {Channel::z, "z", 1, false, inf, "metres along the camera's -Z; +inf: nothing"},
      {Channel::normal, "normal", 3, false, 0.0f, "world XYZ, unit length; 0: nothing"},
      {Channel::position, "position", 3, false, inf, "world XYZ in metres; +inf: nothing"},
      {Channel::uv, "uv", 2, false, 0.0f, "texture coordinates; 0: nothing"},
      {Channel::id, "id", 1, true, -1.0f, "triangle, counted over the scene; -1: nothing"},
      {Channel::object, "object", 1, true, -1.0f, "object number; -1: nothing"},
      {Channel::material, "material", 1, true, -1.0f, "material number; -1: nothing"},
  };
  return table;
}

const ChannelInfo& channel_info(Channel channel) { return channels()[static_cast<size_t>(channel)]; }

Channel channel_from_name(const std::string& name) {
  std::vector<std::string> names;
  for (const ChannelInfo& info : channels()) {
    if (name == info.name) return info.channel;
    names.emplace_back(info.name);
  }
  throw CommandError("{}", unknown_name("channel", name, names));
}

Image make_image(Channel channel, ImageSize size) {
  const ChannelInfo& info = channel_info(channel);
  if (info.integer) return IntImage(size, info.components);
  return FloatImage(size, info.components);
}

std::string size_refusal(ImageSize size, const Limits& limits) {
  const auto pixels = static_cast<size_t>(size.width) * static_cast<size_t>(size.height);
  if (pixels <= limits.picture_pixels) return {};
  return fmt::format("{} x {} pixels: {}", size.width, size.height, limit_text(limits, &Limits::picture_pixels));
}

ImageSize image_size(const Image& image) {
  return std::visit([](const auto& typed) { return typed.size; }, image);
}

int image_components(const Image& image) {
  return std::visit([](const auto& typed) { return typed.components; }, image);
}

}  // namespace omma
