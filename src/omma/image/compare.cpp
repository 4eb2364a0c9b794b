#include "omma/image/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/image/srgb.h"
#include "omma/image/ssim.h"

namespace omma {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double peak_of(const FloatImage& image, Scale scale) {
  if (scale == Scale::display) return 1.0;
  double peak = 0.0;
  for (const float value : image.values) {
    if (std::isfinite(value)) peak = std::max(peak, std::abs(double(value)));
  }
  return peak > 0.0 ? peak : 1.0;
}

/// One component to measure structure in; values that are not finite count as 0.
FloatImage luma(const FloatImage& image) {
  constexpr float rec709[3] = {0.2126f, 0.7152f, 0.0722f};
  FloatImage grey(image.size, 1);
  for (size_t pixel = 0; pixel < grey.values.size(); ++pixel) {
    const float* value = &image.values[pixel * image.components];
    if (image.components == 1) {
      grey.values[pixel] = value[0];
    } else {
      for (int c = 0; c < 3; ++c) grey.values[pixel] += rec709[c] * value[c];
    }
    if (!std::isfinite(grey.values[pixel])) grey.values[pixel] = 0.0f;
  }
  return grey;
}

/// Calls `visit(pixel, differences, one_sided)` for each pixel, `differences` being |a - b| of each component (0 where
/// neither is finite). A one-sided pixel has +inf in the components concerned.
template <typename Visit>
void for_each_pixel(const FloatImage& a, const FloatImage& b, const Visit& visit) {
  std::vector<double> differences(a.components);
  for (size_t pixel = 0; pixel * a.components < a.values.size(); ++pixel) {
    bool one_sided = false;
    for (int c = 0; c < a.components; ++c) {
      const float va = a.values[pixel * a.components + c], vb = b.values[pixel * a.components + c];
      const bool has_a = std::isfinite(va), has_b = std::isfinite(vb);
      one_sided |= has_a != has_b;
      differences[c] = has_a != has_b ? infinity : has_a ? std::abs(double(va) - vb) : 0.0;
    }
    visit(pixel, differences, one_sided);
  }
}

Difference compare(const FloatImage& a, const FloatImage& b, double peak) {
  double largest = 0.0, sum = 0.0, squares = 0.0;
  size_t counted = 0, one_sided_pixels = 0;
  for_each_pixel(a, b, [&](size_t pixel, const std::vector<double>& differences, bool one_sided) {
    one_sided_pixels += one_sided;
    for (int c = 0; c < a.components; ++c) {
      const double difference = differences[c];
      largest = std::max(largest, difference);
      if (difference < infinity && std::isfinite(a.values[pixel * a.components + c])) {
        sum += difference;
        squares += difference * difference;
        ++counted;
      }
    }
  });
  Difference result;
  result.max = largest;
  result.mismatches = one_sided_pixels;
  result.mismatch_share = double(one_sided_pixels) / (double(a.size.width) * a.size.height);
  result.mean = counted ? sum / double(counted) : 0.0;
  result.psnr = squares > 0.0 ? 10.0 * std::log10(peak * peak * double(counted) / squares) : infinity;
  const bool wide_enough = std::min(a.size.width, a.size.height) >= ssim_window;
  if (wide_enough && (a.components == 1 || a.components == 3)) {
    result.ssim = structural_similarity(luma(a), luma(b), peak);
  }
  return result;
}

Difference compare(const IntImage& a, const IntImage& b) {
  Difference result;
  const size_t pixels = a.values.size() / a.components;
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    const auto first = a.values.begin() + ptrdiff_t(pixel * a.components);
    const auto second = b.values.begin() + ptrdiff_t(pixel * a.components);
    result.mismatches += !std::equal(first, first + a.components, second);
  }
  result.mismatch_share = double(result.mismatches) / double(pixels);
  return result;
}

}  // namespace

void require_comparable(const Image& a, const Image& b) {
  const ImageSize size_a = image_size(a), size_b = image_size(b);
  if (size_a != size_b) {
    throw InputError("the images differ in size: {} x {} and {} x {}", size_a.width, size_a.height, size_b.width,
                     size_b.height);
  }
  if (a.index() != b.index()) {
    throw InputError("one image holds whole numbers, the other floats");
  }
  if (image_components(a) != image_components(b)) {
    throw InputError("the images differ in components: {} and {}", image_components(a), image_components(b));
  }
}

FloatImage scaled(FloatImage image, Scale scale) {
  if (scale == Scale::display) {
    for (float& value : image.values) {
      if (std::isfinite(value)) value = srgb_from_linear(value);
    }
  }
  return image;
}

Difference compare_images(const Image& a, const Image& b, Scale scale) {
  require_comparable(a, b);
  if (const auto* numbers = std::get_if<IntImage>(&a)) {
    return compare(*numbers, std::get<IntImage>(b));
  }
  const FloatImage first = scaled(std::get<FloatImage>(a), scale);
  return compare(first, scaled(std::get<FloatImage>(b), scale), peak_of(first, scale));
}

FloatImage difference_image(const Image& a, const Image& b, Scale scale) {
  require_comparable(a, b);
  FloatImage result(image_size(a), 3);
  if (const auto* numbers = std::get_if<IntImage>(&a)) {
    const IntImage& others = std::get<IntImage>(b);
    for (size_t i = 0; i < numbers->values.size(); ++i) {
      if (numbers->values[i] == others.values[i]) continue;
      const size_t pixel = i / numbers->components;
      for (int c = 0; c < 3; ++c) result.values[3 * pixel + c] = 1.0f;
    }
    return result;
  }
  const FloatImage first = scaled(std::get<FloatImage>(a), scale);
  const FloatImage second = scaled(std::get<FloatImage>(b), scale);
  double largest = 0.0;
  for_each_pixel(first, second, [&](size_t, const std::vector<double>& differences, bool) {
    for (const double difference : differences) {
      if (difference < infinity) largest = std::max(largest, difference);
    }
  });
  const double gain = largest > 0.0 ? 1.0 / largest : 0.0;
  const int last = first.components - 1;
  for_each_pixel(first, second, [&](size_t pixel, const std::vector<double>& differences, bool one_sided) {
    for (int c = 0; c < 3; ++c) {
      const double difference = gain * differences[std::min(c, last)];
      const double marker = c == 1 ? 0.0 : 1.0;
      result.values[3 * pixel + c] = float(one_sided ? marker : difference);
    }
  });
  return result;
}

}  // namespace omma
