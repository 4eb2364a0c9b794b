#include "omma/image/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/codec/decode.h"
#include "omma/image/formats.h"
#include "omma/image/npy.h"
#include "omma/image/pfm.h"
#include "omma/image/srgb.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

constexpr int max_components = 4;

Image read_npy_image(const fs::path& path, const Limits& limits) {
  const NpyArray<float> array = read_npy<float>(path, limits);
  const std::vector<size_t>& shape = array.shape;
  const size_t components = shape.size() == 3 ? shape[2] : 1;
  if (shape.size() < 2 || shape.size() > 3 || components < 1 || components > max_components || array.values.empty() ||
      std::max(shape[0], shape[1]) > INT32_MAX) {
    throw InputError("{}: its shape is ({}); an image is H x W or H x W x components (1 to {})", path.string(),
                     fmt::join(shape, ", "), max_components);
  }
  const ImageSize size{int(shape[1]), int(shape[0])};
  if (const std::string why = size_refusal(size, limits); !why.empty()) {
    throw InputError("{}: {}", path.string(), why);
  }
  const auto image_of = [&](auto values) {
    ImageOf<typename decltype(values)::value_type> image;
    image.size = size;
    image.components = int(components);
    image.values = std::move(values);
    return image;
  };
  if (!array.integer) return image_of(array.values);
  NpyArray<int32_t> whole = read_npy<int32_t>(path, limits);
  if (whole.shape != shape) throw InputError("{}: has changed while it was read", path.string());
  return image_of(std::move(whole.values));
}

Pixels decode(const fs::path& path, ImageFormat format, const Limits& limits) {
  const std::string bytes = read_file(path, limits);
  const auto accept = [&](const PictureInfo& info) {
    const int components = info.alpha > 0 ? info.alpha : info.components;
    if (components > max_components) {
      throw InputError("{} components a pixel; up to {} are read", components, max_components);
    }
    if (const std::string why = size_refusal(info.size, limits); !why.empty()) throw InputError("{}", why);
  };
  try {
    switch (format) {
      case ImageFormat::png:
        return decode_png(bytes, accept);
      case ImageFormat::jpg:
        return decode_jpeg(bytes, accept);
      default:
        return decode_exr(bytes, accept);
    }
  } catch (const InputError& error) {
    throw InputError("{}: {}", path.string(), error.what());
  }
}

/// The image without its alpha; `value(sample, alpha)` makes what it holds.
template <typename T, typename S, typename Value>
ImageOf<T> without_alpha(const Pixels& pixels, const SampleVector<S>& samples, const Value& value) {
  const int alpha = pixels.info.alpha;
  ImageOf<T> image(pixels.info.size, alpha > 0 ? alpha : pixels.info.components);
  const bool covers = alpha > 0 && alpha < pixels.stored();
  const S* from = samples.data();
  T* to = image.values.data();
  for (size_t i = 0; i < image.values.size() / size_t(image.components); ++i, from += pixels.stored()) {
    const S cover = covers ? from[alpha] : std::numeric_limits<S>::max();
    for (int c = 0; c < image.components; ++c) *to++ = value(from[c], cover);
  }
  return image;
}

/// Numbers of a .png or .jpg, which are colour; a pixel that is not wholly there is that much darker.
template <typename S>
FloatImage linear_image(const Pixels& pixels, const SampleVector<S>& samples) {
  constexpr uint32_t largest = std::numeric_limits<S>::max();
  std::vector<float> linear(largest + 1);
  for (uint32_t i = 0; i <= largest; ++i) linear[i] = linear_from_srgb(float(i) * (1.0f / float(largest)));
  return without_alpha<float>(pixels, samples,
                              [&](S sample, S alpha) { return linear[uint32_t{sample} * alpha / largest]; });
}

Image read_encoded(const fs::path& path, ImageFormat format, const Limits& limits) {
  const Pixels pixels = decode(path, format, limits);
  const auto as_it_is = [](auto sample, auto) { return sample; };
  return std::visit(
      [&]<typename S>(const SampleVector<S>& samples) -> Image {
        if constexpr (std::is_same_v<S, float>) {
          return without_alpha<float>(pixels, samples, as_it_is);
        } else if constexpr (std::is_same_v<S, uint32_t>) {
          return without_alpha<int32_t>(pixels, samples, as_it_is);
        } else if (std::is_same_v<S, uint16_t> && pixels.info.components <= 2) {
          return without_alpha<int32_t>(pixels, samples, [](uint32_t number, uint32_t alpha) {
            return static_cast<int32_t>(number * alpha / 65535U) - 1;
          });
        } else {
          return linear_image(pixels, samples);
        }
      },
      pixels.samples);
}

}  // namespace

Image read_image(const fs::path& path, const Limits& limits) {
  const ImageFormatInfo* format = find_image_format(path);
  if (!format) {
    throw CommandError("{}: '{}' is no image format; {} are", path.string(), path.extension().string(),
                       all_image_extensions());
  }
  if (format->format == ImageFormat::npy) return read_npy_image(path, limits);
  if (format->format == ImageFormat::pfm) return read_pfm(path, limits);
  return read_encoded(path, format->format, limits);
}

}  // namespace omma
