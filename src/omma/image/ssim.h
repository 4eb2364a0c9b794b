// Structural similarity of two grey images.
#pragma once

#include "omma/image/image.h"

namespace omma {

constexpr int ssim_window = 11;

/// Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE
/// Transactions on Image Processing 13(4), 2004. `a` and `b` have one component, finite values, and the same size of at
/// least ssim_window pixels either way; `peak` is the range of their values.
double structural_similarity(const FloatImage& a, const FloatImage& b, double peak);

}  // namespace omma
