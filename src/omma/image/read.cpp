#include "omma/image/read.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/formats.h"
#include "omma/image/npy.h"
#include "omma/image/pfm.h"
#include "omma/image/srgb.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

constexpr int max_components = 4;
/// 32768 x 32768: a broken header must not be able to ask for all memory.
constexpr int64_t max_pixels = int64_t{1} << 30;

Image read_npy_image(const fs::path& path) {
  const NpyArray<float> array = read_npy<float>(path);
  const std::vector<size_t>& shape = array.shape;
  const size_t components = shape.size() == 3 ? shape[2] : 1;
  if (shape.size() < 2 || shape.size() > 3 || components < 1 || components > max_components || array.values.empty() ||
      array.values.size() / components > size_t(max_pixels)) {
    throw InputError("{}: its shape is ({}); an image is H x W or H x W x components (1 to {})", path.string(),
                     fmt::join(shape, ", "), max_components);
  }
  const ImageSize size{int(shape[1]), int(shape[0])};
  const auto image_of = [&](auto values) {
    ImageOf<typename decltype(values)::value_type> image;
    image.size = size;
    image.components = int(components);
    image.values = std::move(values);
    return image;
  };
  if (array.integer) return image_of(read_npy<int32_t>(path).values);
  return image_of(array.values);
}

template <typename T>
ImageOf<T> read_components(OIIO::ImageInput& input, const fs::path& path, int components, OIIO::TypeDesc type) {
  ImageOf<T> image({input.spec().width, input.spec().height}, components);
  if (!input.read_image(0, 0, 0, components, type, image.values.data())) {
    throw InputError("{}: broken or truncated ({})", path.string(), input.geterror());
  }
  return image;
}

/// Decoders fill in what a truncated file lacks, or complain on standard error by themselves.
void require_whole(const fs::path& path, ImageFormat format) {
  using namespace std::string_view_literals;
  const std::string bytes = read_file(path);
  if (bytes.empty()) throw InputError("{}: the file is empty", path.string());
  constexpr size_t slack = 1024;  // some programs append something
  const std::string_view end = std::string_view(bytes).substr(bytes.size() - std::min(bytes.size(), slack));
  const std::string_view mark = format == ImageFormat::png   ? "IEND"sv
                                : format == ImageFormat::jpg ? "\xff\xd9"sv
                                                             : ""sv;
  if (end.find(mark) == std::string_view::npos) {
    throw InputError("{}: truncated, or no image of its extension (the mark of the file's end is missing)",
                     path.string());
  }
}

Image read_encoded(const fs::path& path, ImageFormat format) {
  require_whole(path, format);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) {
    throw InputError("{}: is not an image of its extension ({})", path.string(), OIIO::geterror());
  }
  const OIIO::ImageSpec& spec = input->spec();
  // Alpha comes last in every format read here.
  const int components = spec.alpha_channel > 0 ? spec.alpha_channel : spec.nchannels;
  if (spec.width <= 0 || spec.height <= 0 || int64_t{spec.width} * spec.height > max_pixels ||
      components > max_components) {
    throw InputError("{}: {} x {} pixels of {} components; up to {} pixels of {} are read", path.string(), spec.width,
                     spec.height, components, max_pixels, max_components);
  }
  if (format == ImageFormat::exr) {
    if (spec.format == OIIO::TypeUInt32) {
      return read_components<int32_t>(*input, path, components, OIIO::TypeUInt32);
    }
    return read_components<float>(*input, path, components, OIIO::TypeFloat);
  }
  if (format == ImageFormat::png && components == 1 && spec.format == OIIO::TypeUInt16) {
    const auto numbers = read_components<uint16_t>(*input, path, 1, OIIO::TypeUInt16);
    IntImage image(numbers.size, 1);
    std::transform(numbers.values.begin(), numbers.values.end(), image.values.begin(),
                   [](uint16_t number) { return int32_t{number} - 1; });
    return image;
  }
  FloatImage image = read_components<float>(*input, path, components, OIIO::TypeFloat);
  std::transform(image.values.begin(), image.values.end(), image.values.begin(), linear_from_srgb);
  return image;
}

}  // namespace

Image read_image(const fs::path& path) {
  const ImageFormatInfo* format = find_image_format(path);
  if (!format) {
    throw CommandError("{}: '{}' is no image format; {} are", path.string(), path.extension().string(),
                       all_image_extensions());
  }
  if (format->format == ImageFormat::npy) return read_npy_image(path);
  if (format->format == ImageFormat::pfm) return read_pfm(path);
  return read_encoded(path, format->format);
}

}  // namespace omma
