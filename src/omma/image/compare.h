// How far apart two images are.
#pragma once

#include <cstddef>
#include <optional>

#include "omma/image/image.h"

namespace omma {

/// What the numbers of two float images mean.
enum class Scale {
  display,  ///< linear colour, compared as a screen shows it: clamped to 0..1 and sRGB encoded; the peak is 1
  raw,      ///< numbers of any unit, compared as they are; the peak is the first image's largest finite magnitude
};

/// Nothing where a metric makes no sense for the images. A pixel is one-sided when exactly one of the images has a
/// finite value there, in any component.
struct Difference {
  // Float images.
  std::optional<double> max;   ///< largest |a - b| over all components; +inf when a pixel is one-sided
  std::optional<double> mean;  ///< of |a - b| over the components finite in both
  std::optional<double> psnr;  ///< decibels over the components finite in both; +inf when they are equal
  /// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004) of Rec. 709 luma (one component: itself), Gaussian
  /// window of 11 pixels and sigma 1.5, K1 = 0.01, K2 = 0.03, mean over the windows that lie inside the image. Values
  /// that are not finite count as 0. Nothing for images under 11 pixels, or of two or four components.
  std::optional<double> ssim;

  /// Integer images: pixels whose numbers differ. Float images: one-sided pixels.
  size_t mismatches = 0;
  double mismatch_share = 0.0;  ///< of all pixels
};

/// Throws InputError when the images differ in size, components or kind.
void require_comparable(const Image& a, const Image& b);

/// The numbers that are compared: finite ones sRGB encoded for Scale::display.
FloatImage scaled(FloatImage image, Scale scale);

/// Throws as require_comparable does.
Difference compare_images(const Image& a, const Image& b, Scale scale);

/// RGB, linear: |a - b| over its largest value, so that the largest difference is white and equal images are black;
/// one-sided pixels magenta, differing numbers white. Throws as require_comparable does.
FloatImage difference_image(const Image& a, const Image& b, Scale scale);

}  // namespace omma
