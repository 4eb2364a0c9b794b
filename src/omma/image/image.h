// Images of floats or of whole numbers, and the channels a picture is made of.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "omma/base/limits.h"
#include "omma/math/ray.h"

namespace omma {

/// What a picture can hold for every pixel. Everything but `color` is sampled at the pixel's centre and never blended.
enum class Channel {
  color,     ///< RGB, linear light
  distance,  ///< metres along the ray, +inf where there is nothing
  z,         ///< metres along the camera's -Z, +inf where there is nothing; negative behind the camera
  normal,    ///< XYZ in the world, unit length, towards the camera; zero where there is nothing
  position,  ///< XYZ in world metres; +inf where there is nothing
  uv,        ///< texture coordinates; zero where there is nothing
  id,        ///< triangle, counted over all instances in the scene's order; -1 where there is nothing
  object,    ///< instance's object number; -1 where there is nothing
  material,  ///< material number; -1 where there is nothing
};

struct ChannelInfo {
  Channel channel;
  const char* name;
  int components;  ///< 1, 2 or 3
  bool integer;    ///< int32 rather than float
  float nothing;   ///< the value where there is nothing
  const char* description;
};

/// Every channel, in the order of the enumeration.
const std::vector<ChannelInfo>& channels();
const ChannelInfo& channel_info(Channel channel);
/// Throws CommandError with the nearest name when there is no such channel.
Channel channel_from_name(const std::string& name);

/// Rows from the top, pixels from the left, components interleaved: `values[(y * width + x) * components + c]`.
template <typename T>
struct ImageOf {
  ImageSize size;
  int components = 1;
  std::vector<T> values;

  ImageOf() = default;
  ImageOf(ImageSize image_size, int component_count, T value = T{})
      : size(image_size),
        components(component_count),
        values(size_t(image_size.width) * image_size.height * component_count, value) {}

  T* at(int x, int y) { return values.data() + (size_t(y) * size.width + x) * components; }
  const T* at(int x, int y) const { return values.data() + (size_t(y) * size.width + x) * components; }
};

using FloatImage = ImageOf<float>;
using IntImage = ImageOf<int32_t>;
using ByteImage = ImageOf<uint8_t>;  ///< encoded, as a screen takes it
using Image = std::variant<FloatImage, IntImage>;

/// Of a channel's kind and components, all zero.
Image make_image(Channel channel, ImageSize size);

/// Why a picture of this size is not made, "40000 x 40000 pixels: the limit …"; empty where it is.
std::string size_refusal(ImageSize size, const Limits& limits);

ImageSize image_size(const Image& image);
int image_components(const Image& image);

}  // namespace omma
